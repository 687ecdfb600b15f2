#pragma once

#include <grpcpp/grpcpp.h>

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>

#include "grpc/rpc_record.h"
#include "guard/gatekeeper.h"
#include "service/caller.h"
#include "vsplit/base/expected.h"

namespace vsplit::rpc {

/// Knows how many rpcs run, so that a server that stops waits for them and for nothing else; and who may make one. Thread-safe.
class RpcLedger {
public:
    /// \param gate null: everybody comes in; it must outlive the ledger. \param most rpcs at a time; 0: no limit
    RpcLedger(RpcObserver observer, guard::Gatekeeper* gate, std::size_t most);

    /// Begins an rpc and decides on it, once: the owner that it is for, or why it may not do its work.
    /// \return what Gatekeeper::admit returns, LIMIT_EXCEEDED.
    [[nodiscard]] Expected<std::string> begin(std::string_view method, const CallOrigin& origin);
    void end(const RpcRecord& record);

    /// The name of the token that a call carries, for the log; empty for none that is known.
    [[nodiscard]] std::string name_of(const CallOrigin& origin) const;

    /// Whether a new rpc may do its work. \return UNAVAILABLE after `close`.
    [[nodiscard]] Status admit() const;
    void close();

    /// Waits until no rpc runs, at most so long. Whether none does.
    bool wait_until_idle(std::chrono::milliseconds longest);

private:
    const RpcObserver observer_;
    guard::Gatekeeper* const gate_;
    const std::size_t most_;
    mutable std::mutex mutex_;
    std::condition_variable idle_;
    std::size_t running_ = 0;
    bool closed_ = false;
};

/// What an rpc of vsplit.v1.Meshing needs: those that the contract marks NO_SIDE_EFFECTS read, any other writes.
[[nodiscard]] guard::Access access_of(std::string_view method);

/// One rpc from its beginning to its end. Copies are the same rpc.
class RpcWatch {
public:
    /// Tells the client the request's id. \pre `method` is a literal; `ledger` outlives the rpc.
    RpcWatch(RpcLedger& ledger, grpc::CallbackServerContext& context, std::string_view method, std::string session);

    /// Where the request does not name it. From the thread that finishes the rpc.
    void set_session(std::string session) const { entry_->session = std::move(session); }

    /// Whether the rpc may do its work. \return what RpcLedger::begin and RpcLedger::admit return.
    [[nodiscard]] Status admit() const;

    /// On whose behalf. Where the rpc was not admitted, on nobody's: nothing is found then.
    [[nodiscard]] const service::Caller& caller() const { return entry_->caller; }

    /// Once for each rpc.
    void finished(const grpc::Status& status) const;

private:
    struct Entry {
        CallOrigin origin;
        std::string session;
        std::string token;  // the name of the call's, admitted or not
        service::Caller caller;
        Status admitted = Done{};
        std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
    };

    RpcLedger* ledger_;
    std::string_view method_;
    std::shared_ptr<Entry> entry_;
};

}  // namespace vsplit::rpc

#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <mutex>
#include <string>
#include <string_view>

#include "grpc/rpc_record.h"
#include "vsplit/base/expected.h"

namespace vsplit::rpc {

/// Knows how many rpcs run, so that a server that stops waits for them and for nothing else. Thread-safe.
class RpcLedger {
public:
    explicit RpcLedger(RpcObserver observer);

    void begin();
    void end(const RpcRecord& record);

    /// Whether a new rpc may do its work. \return UNAVAILABLE after `close`.
    [[nodiscard]] Status admit() const;
    void close();

    /// Waits until no rpc runs, at most so long.
    void wait_until_idle(std::chrono::milliseconds longest);

private:
    const RpcObserver observer_;
    mutable std::mutex mutex_;
    std::condition_variable idle_;
    std::size_t running_ = 0;
    bool closed_ = false;
};

/// One rpc from its beginning to its end. Copies are the same rpc.
class RpcWatch {
public:
    /// \pre `method` is a literal; `ledger` outlives the rpc.
    RpcWatch(RpcLedger& ledger, std::string_view method, std::string session);

    void set_session(std::string session) { session_ = std::move(session); }
    [[nodiscard]] Status admit() const { return ledger_->admit(); }

    /// Once for each rpc.
    void finished(const grpc::Status& status) const;

private:
    RpcLedger* ledger_;
    std::string_view method_;
    std::string session_;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace vsplit::rpc

#pragma once

#include <grpcpp/generic/generic_stub.h>
#include <grpcpp/grpcpp.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "rest/asio.h"
#include "rest/signal.h"

namespace vsplit::rest {

/// How many rpcs there are. The channel must not be let go by gRPC's own thread, which would then wait for itself: whoever owns
/// it waits for the last rpc first. Thread-safe.
class LiveCalls {
public:
    void begin() {
        const std::lock_guard lock(mutex_);
        ++count_;
    }

    void end() {
        const std::lock_guard lock(mutex_);
        if (--count_ == 0) none_.notify_all();
    }

    void wait_for_none() {
        std::unique_lock lock(mutex_);
        none_.wait(lock, [this] { return count_ == 0; });
    }

private:
    std::mutex mutex_;
    std::condition_variable none_;
    std::size_t count_ = 0;
};

/// One rpc of any kind, in messages that nobody has taken apart: what is on the wire. For one coroutine on one strand. Whoever
/// lets go of one that is not finished cancels it.
///
/// A read is always under way, so that one message more than was asked for is here: in process, gRPC 1.51 drops the message that
/// a server sends together with its status when nobody waits for it.
class RpcCall : public std::enable_shared_from_this<RpcCall> {
public:
    using Metadata = std::multimap<std::string, std::string>;

    /// Begins it. `method` is "/package.Service/Method".
    [[nodiscard]] static std::shared_ptr<RpcCall> start(grpc::GenericStub& stub, const std::string& method,
                                                        const Metadata& metadata, LiveCalls& live,
                                                        const net::any_io_executor& executor);

    RpcCall(const RpcCall&) = delete;
    RpcCall& operator=(const RpcCall&) = delete;
    ~RpcCall() = default;

    /// Sends a message; returns when the server has taken it, which is what keeps a client from running ahead. False when the rpc
    /// is over: nobody wants more.
    Awaitable<bool> write(const grpc::ByteBuffer& message, bool last);

    /// Whether it is over already: there is nobody to write to, and no message to read.
    [[nodiscard]] bool over() const { return over_; }

    /// Waits at most so long for it to be over.
    Awaitable<bool> over_within(std::chrono::milliseconds longest);

    /// No more messages.
    Awaitable<void> writes_done();

    /// The next message; empty at the end.
    Awaitable<std::optional<grpc::ByteBuffer>> read();

    /// How it ended. After `read` has come to the end, or `cancel`.
    Awaitable<grpc::Status> finish();

    /// Any thread, any time.
    void cancel() { context_.TryCancel(); }

private:
    class Reactor;

    // Told last of all that goes with a call.
    struct Presence {
        explicit Presence(LiveCalls& calls) : live(calls) { live.begin(); }
        Presence(const Presence&) = delete;
        Presence& operator=(const Presence&) = delete;
        ~Presence() { live.end(); }
        LiveCalls& live;
    };

    RpcCall(LiveCalls& live, const net::any_io_executor& executor);

    void release();

    const Presence presence_;
    grpc::ClientContext context_;
    const std::shared_ptr<Signal> written_;
    const std::shared_ptr<Signal> got_;
    const std::shared_ptr<Signal> done_;
    Reactor* reactor_ = nullptr;  // deletes itself when the rpc is over and it is not held

    // Written by gRPC before the signal is set, read after it.
    bool write_ok_ = false;
    bool read_ok_ = false;
    std::atomic<bool> over_{false};
    grpc::ByteBuffer out_;
    grpc::ByteBuffer in_;
    grpc::Status status_;
};

}  // namespace vsplit::rest

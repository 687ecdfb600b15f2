#include "rest/rpc_call.h"

#include <utility>

namespace vsplit::rest {

// Lives until gRPC is done with the rpc, and keeps the call so long.
class RpcCall::Reactor final : public grpc::ClientBidiReactor<grpc::ByteBuffer, grpc::ByteBuffer> {
public:
    explicit Reactor(std::shared_ptr<RpcCall> call) : call_(std::move(call)) {}

    void OnWriteDone(bool ok) override {
        call_->write_ok_ = ok;
        call_->written_->set();
    }

    void OnWritesDoneDone(bool /*ok*/) override { call_->written_->set(); }

    void OnReadDone(bool ok) override {
        call_->read_ok_ = ok;
        if (!ok) call_->over_ = true;
        call_->got_->set();
    }

    void OnDone(const grpc::Status& status) override {
        call_->status_ = status;
        call_->done_->set();
        delete this;
    }

private:
    const std::shared_ptr<RpcCall> call_;
};

RpcCall::RpcCall(LiveCalls& live, const net::any_io_executor& executor)
    : presence_(live),
      written_(std::make_shared<Signal>(executor)),
      got_(std::make_shared<Signal>(executor)),
      done_(std::make_shared<Signal>(executor)) {}

std::shared_ptr<RpcCall> RpcCall::start(grpc::GenericStub& stub, const std::string& method, const Metadata& metadata,
                                        LiveCalls& live, const net::any_io_executor& executor) {
    std::shared_ptr<RpcCall> call(new RpcCall(live, executor));
    for (const auto& [name, value] : metadata) call->context_.AddMetadata(name, value);
    call->reactor_ = new Reactor(call);
    stub.PrepareBidiStreamingCall(&call->context_, method, {}, call->reactor_);
    // The coroutine starts writes and reads; without the hold gRPC could be done with the reactor between two of them.
    call->reactor_->AddHold();
    call->reactor_->StartRead(&call->in_);
    call->reactor_->StartCall();
    RpcCall* const bare = call.get();
    return {bare, [call = std::move(call)](RpcCall* /*the same*/) { call->release(); }};
}

void RpcCall::release() {
    if (reactor_ == nullptr) return;
    cancel();
    std::exchange(reactor_, nullptr)->RemoveHold();
}

Awaitable<bool> RpcCall::write(const grpc::ByteBuffer& message, bool last) {
    const std::shared_ptr<RpcCall> self = shared_from_this();
    out_ = message;  // shares its slices
    if (last) {
        reactor_->StartWriteLast(&out_, {});
    } else {
        reactor_->StartWrite(&out_);
    }
    co_await written_->wait();
    out_.Clear();
    co_return write_ok_;
}

Awaitable<bool> RpcCall::over_within(std::chrono::milliseconds longest) {
    const std::shared_ptr<RpcCall> self = shared_from_this();
    constexpr std::chrono::milliseconds kStep(1);
    net::steady_timer timer(written_->executor());
    for (const auto until = std::chrono::steady_clock::now() + longest; !over_ && std::chrono::steady_clock::now() < until;) {
        timer.expires_after(kStep);
        ErrorCode ignored;
        co_await timer.async_wait(into(ignored));
    }
    co_return over_;
}

Awaitable<void> RpcCall::writes_done() {
    const std::shared_ptr<RpcCall> self = shared_from_this();
    reactor_->StartWritesDone();
    co_await written_->wait();
}

Awaitable<std::optional<grpc::ByteBuffer>> RpcCall::read() {
    const std::shared_ptr<RpcCall> self = shared_from_this();
    co_await got_->wait();
    if (!read_ok_) co_return std::nullopt;
    grpc::ByteBuffer message;
    message.Swap(&in_);
    reactor_->StartRead(&in_);
    co_return message;
}

Awaitable<grpc::Status> RpcCall::finish() {
    const std::shared_ptr<RpcCall> self = shared_from_this();
    std::exchange(reactor_, nullptr)->RemoveHold();
    co_await done_->wait();
    co_return status_;
}

}  // namespace vsplit::rest

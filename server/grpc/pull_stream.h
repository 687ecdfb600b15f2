#pragma once

#include <grpcpp/grpcpp.h>

#include <memory>
#include <mutex>
#include <utility>

#include "grpc/message_source.h"
#include "grpc/rpc_ledger.h"
#include "service/guarded.h"
#include "vsplit/base/expected.h"
#include "wire/error_table.h"

namespace vsplit::rpc {

/// A server's stream that writes what its source gives.
///
/// Whoever sets `busy_` owns the source and the message until it gives them back, to OnWriteDone or by clearing it; Finish is
/// called by the owner only, so that no write follows it or is under way. No lock is held while gRPC or the source is called.
template <class Message>
class PullStream final : public grpc::ServerWriteReactor<Message>, public std::enable_shared_from_this<PullStream<Message>> {
public:
    using Source = MessageSource<Message>;
    using SourcePointer = std::unique_ptr<Source>;

    /// A stream of what `make(caller, wake)`, an Expected<SourcePointer>, gives. It lives until gRPC is done with it, and a
    /// little longer where a wake is just under way.
    template <class Make>
    static PullStream* open(RpcWatch watch, const Make& make) {
        const auto stream = std::make_shared<PullStream>(Private(), std::move(watch));
        stream->self_ = stream;
        PullStream* const bare = stream.get();
        Expected<SourcePointer> source = service::guarded([&]() -> Expected<SourcePointer> {
            if (Status open = stream->watch_.admit(); !open) return open.error();
            return make(stream->watch_.caller(), stream->make_wake());
        });
        if (source) {
            stream->source_ = *std::move(source);
            stream->give_back();
        } else {
            stream->finish(wire::to_status(source.error()));
        }
        return bare;
    }

    void OnWriteDone(bool ok) override {
        if (!ok) note_cancelled();
        give_back();
    }

    void OnCancel() override {
        note_cancelled();
        wake();
    }

    void OnDone() override {
        const std::shared_ptr<PullStream> last = std::move(self_);  // may delete this at the end of the scope
    }

private:
    struct Private {};

public:
    PullStream(Private /*only open makes streams*/, RpcWatch watch) : watch_(std::move(watch)) {}

private:
    using Step = typename Source::Step;

    [[nodiscard]] Wake make_wake() {
        return [weak = this->weak_from_this()] {
            if (const std::shared_ptr<PullStream> stream = weak.lock()) stream->wake();
        };
    }

    void note_cancelled() {
        const std::lock_guard lock(mutex_);
        cancelled_ = true;
    }

    void wake() {
        {
            const std::lock_guard lock(mutex_);
            woken_ = true;
            if (busy_) return;
            busy_ = true;
        }
        pump();
    }

    // The owner has nothing under way: goes on.
    void give_back() { pump(); }

    // \pre the caller owns the source. Writes, finishes, or gives the ownership up until the next wake.
    void pump() {
        while (take_turn()) {
            grpc::Status end;
            const Step step = next(end);
            if (step == Step::kMessage) return this->StartWrite(&message_);
            if (step == Step::kEnd) return finish(end);
            if (!stay_awake()) return;
        }
        source_->cancel();
        finish(grpc::Status(grpc::StatusCode::CANCELLED, "the client is gone or its deadline has passed"));
    }

    // False when there is nobody left to write to.
    [[nodiscard]] bool take_turn() {
        const std::lock_guard lock(mutex_);
        woken_ = false;
        return !cancelled_;
    }

    // Whether something happened since take_turn; if not, gives the ownership up.
    [[nodiscard]] bool stay_awake() {
        const std::lock_guard lock(mutex_);
        busy_ = woken_ || cancelled_;
        return busy_;
    }

    [[nodiscard]] Step next(grpc::Status& end) {
        const Expected<Step> step = service::guarded([&]() -> Expected<Step> { return source_->next(message_, end); });
        if (step) return *step;
        end = wire::to_status(step.error());
        return Step::kEnd;
    }

    // The owner keeps the ownership for good: nothing is written after this.
    void finish(const grpc::Status& status) {
        watch_.finished(status);
        source_.reset();  // what it holds is freed now, not when the client has heard of the end
        this->Finish(status);
    }

    const RpcWatch watch_;
    SourcePointer source_;
    Message message_;
    std::mutex mutex_;
    bool busy_ = true;
    bool woken_ = false;
    bool cancelled_ = false;
    std::shared_ptr<PullStream> self_;
};

}  // namespace vsplit::rpc

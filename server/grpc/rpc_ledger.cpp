#include "grpc/rpc_ledger.h"

#include <utility>

namespace vsplit::rpc {

RpcLedger::RpcLedger(RpcObserver observer) : observer_(std::move(observer)) {}

void RpcLedger::begin() {
    const std::lock_guard lock(mutex_);
    ++running_;
}

void RpcLedger::end(const RpcRecord& record) {
    if (observer_) observer_(record);
    // Told under the lock: who waits may destroy the ledger as soon as it is released.
    const std::lock_guard lock(mutex_);
    if (--running_ == 0) idle_.notify_all();
}

Status RpcLedger::admit() const {
    const std::lock_guard lock(mutex_);
    if (closed_) return Error{Cause::kUnavailable, "the server is shutting down", ""};
    return Done{};
}

void RpcLedger::close() {
    const std::lock_guard lock(mutex_);
    closed_ = true;
}

void RpcLedger::wait_until_idle(std::chrono::milliseconds longest) {
    std::unique_lock lock(mutex_);
    idle_.wait_for(lock, longest, [this] { return running_ == 0; });
}

RpcWatch::RpcWatch(RpcLedger& ledger, std::string_view method, std::string session)
    : ledger_(&ledger), method_(method), session_(std::move(session)) {
    ledger_->begin();
}

void RpcWatch::finished(const grpc::Status& status) const {
    ledger_->end({method_, session_, status, std::chrono::steady_clock::now() - start_});
}

}  // namespace vsplit::rpc

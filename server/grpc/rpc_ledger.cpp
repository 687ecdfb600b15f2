#include "grpc/rpc_ledger.h"

#include <google/protobuf/descriptor.h>

#include <utility>

#include "service/limits.h"
#include "vsplit/v1/meshing.grpc.pb.h"

namespace vsplit::rpc {
namespace {

// The name of no token: whatever asks on behalf of it finds nothing.
constexpr const char* kNobody = "(nobody)";

}  // namespace

RpcLedger::RpcLedger(RpcObserver observer, guard::Gatekeeper* gate, std::size_t most)
    : observer_(std::move(observer)), gate_(gate), most_(most) {}

guard::Access access_of(std::string_view method) {
    const google::protobuf::ServiceDescriptor* const contract =
        google::protobuf::DescriptorPool::generated_pool()->FindServiceByName(v1::Meshing::service_full_name());
    const google::protobuf::MethodDescriptor* const rpc = contract->FindMethodByName(std::string(method));
    const bool reads = rpc != nullptr && rpc->options().idempotency_level() == google::protobuf::MethodOptions::NO_SIDE_EFFECTS;
    return reads ? guard::Access::kRead : guard::Access::kWrite;
}

Expected<std::string> RpcLedger::begin(std::string_view method, const CallOrigin& origin) {
    {
        const std::lock_guard lock(mutex_);
        ++running_;
        if (most_ != 0 && running_ > most_) {
            return Error{Cause::kLimitExceeded,
                         std::to_string(most_) + " rpcs run in this server, its limit max_rpcs; try again when some are done", "",
                         service::kRetryAfter};
        }
    }
    if (gate_ == nullptr) return std::string();
    return gate_->admit({origin.authorization, origin.peer}, access_of(method));
}

std::string RpcLedger::name_of(const CallOrigin& origin) const {
    return gate_ == nullptr ? std::string() : gate_->name_of(origin.authorization);
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

bool RpcLedger::wait_until_idle(std::chrono::milliseconds longest) {
    std::unique_lock lock(mutex_);
    return idle_.wait_for(lock, longest, [this] { return running_ == 0; });
}

RpcWatch::RpcWatch(RpcLedger& ledger, grpc::CallbackServerContext& context, std::string_view method, std::string session)
    : ledger_(&ledger), method_(method) {
    Entry entry;
    entry.session = std::move(session);
    entry.origin = origin_of(context);
    Expected<std::string> owner = ledger_->begin(method, entry.origin);
    entry.token = owner ? *owner : ledger_->name_of(entry.origin);
    if (!owner) entry.admitted = owner.error();
    const wire::TraceContext& trace = entry.origin.trace;
    entry.caller = {owner ? *owner : kNobody, {entry.origin.request_id, trace.trace_id, trace.span_id}};
    entry.origin.authorization.clear();
    context.AddInitialMetadata(wire::kRequestIdKey, entry.origin.request_id);
    entry_ = std::make_shared<Entry>(std::move(entry));
}

Status RpcWatch::admit() const { return entry_->admitted ? ledger_->admit() : entry_->admitted; }

void RpcWatch::finished(const grpc::Status& status) const {
    ledger_->end(
        {method_, entry_->session, status, std::chrono::steady_clock::now() - entry_->start, entry_->token, entry_->origin});
}

}  // namespace vsplit::rpc

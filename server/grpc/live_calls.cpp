#include "grpc/live_calls.h"

#include <grpc/grpc.h>
#include <grpcpp/grpcpp.h>

#include <algorithm>
#include <string>
#include <utility>

#include "service/limits.h"

namespace vsplit::rpc {
namespace {

constexpr std::size_t kFew = 100;
constexpr std::size_t kOpenShare = 10;

// Of calls that are there, those that their clients are done with included.
std::size_t with_leaving(std::size_t limit) { return 2 * limit + kFew; }

Error too_many(std::size_t limit, const char* what, const char* name) {
    return {Cause::kLimitExceeded,
            std::to_string(limit) + ' ' + what + ", the server's limit " + name + "; try again when some are done", "",
            service::kRetryAfter};
}

bool stays(MethodName::Kind kind) { return kind == MethodName::Kind::kOpen || kind == MethodName::Kind::kUnknown; }

// Null for a call within the process.
const grpc_auth_context* connection_of(grpc_call* call) {
    grpc_auth_context* const connection = grpc_call_auth_context(call);
    grpc_auth_context_release(connection);  // the call holds it
    return connection;
}

}  // namespace

/// One a call, made when gRPC hands it over and gone when nothing of it is left.
class LiveCalls::Call final : public grpc::experimental::Interceptor {
public:
    Call(LiveCalls& calls, grpc::experimental::ServerRpcInfo& info)
        : calls_(calls), info_(info), kind_(method_name(info.method()).kind) {}
    ~Call() override {
        if (connection_ != nullptr) calls_.end(connection_, kind_);
    }
    Call(const Call&) = delete;
    Call& operator=(const Call&) = delete;

    // The first time before the handler has the call; earlier its context may not have it.
    void Intercept(grpc::experimental::InterceptorBatchMethods* methods) override {
        if (!std::exchange(counted_, true)) {
            grpc_call* const call = info_.server_context()->c_call();
            connection_ = connection_of(call);
            const Status within = connection_ == nullptr ? Status(Done{}) : calls_.begin(connection_, kind_);
            if (!within) {
                grpc_call_cancel_with_status(call, GRPC_STATUS_RESOURCE_EXHAUSTED, within.error().message.c_str(), nullptr);
            }
        }
        methods->Proceed();
    }

private:
    LiveCalls& calls_;
    grpc::experimental::ServerRpcInfo& info_;
    const MethodName::Kind kind_;
    bool counted_ = false;
    const grpc_auth_context* connection_ = nullptr;
};

class LiveCalls::Factory final : public grpc::experimental::ServerInterceptorFactoryInterface {
public:
    explicit Factory(LiveCalls& calls) : calls_(calls) {}

    grpc::experimental::Interceptor* CreateServerInterceptor(grpc::experimental::ServerRpcInfo* info) override {
        return new Call(calls_, *info);
    }

private:
    LiveCalls& calls_;
};

LiveCalls::LiveCalls(std::size_t most, std::size_t streams) : most_(most), streams_(streams) {}

Status LiveCalls::admit(const grpc_auth_context* connection, MethodName::Kind kind) const {
    const std::lock_guard lock(mutex_);
    const auto here = by_connection_.find(connection);
    if (here != by_connection_.end() && here->second >= with_leaving(streams_)) {
        return too_many(streams_, "rpcs run on this connection, and as many are not cleared away", "max_streams");
    }
    if (most_ == 0) return Done{};
    if (all_ >= with_leaving(most_)) return too_many(most_, "rpcs run in this server", "max_rpcs");
    return stays(kind) ? admit_open(open_ + 1) : Status(Done{});
}

// Lock held, or no need of one.
Status LiveCalls::admit_open(std::size_t calls) const {
    const std::size_t most = std::max(kFew, most_ / kOpenShare);
    if (most_ == 0 || calls <= most) return Done{};
    return too_many(most, "calls of health and reflection run in this server", "of them by max_rpcs");
}

std::unique_ptr<grpc::experimental::ServerInterceptorFactoryInterface> LiveCalls::counter() {
    return std::make_unique<Factory>(*this);
}

Status LiveCalls::begin(const grpc_auth_context* connection, MethodName::Kind kind) {
    const std::lock_guard lock(mutex_);
    ++by_connection_[connection];
    ++all_;
    return stays(kind) ? admit_open(++open_) : Status(Done{});
}

void LiveCalls::end(const grpc_auth_context* connection, MethodName::Kind kind) {
    const std::lock_guard lock(mutex_);
    const auto here = by_connection_.find(connection);
    if (--here->second == 0) by_connection_.erase(here);
    --all_;
    if (stays(kind)) --open_;
}

}  // namespace vsplit::rpc

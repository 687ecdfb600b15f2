#pragma once

#include <grpcpp/support/status.h>

#include <chrono>
#include <functional>
#include <string>
#include <string_view>

namespace vsplit::rpc {

/// One rpc that ended.
struct RpcRecord {
    std::string_view method;  ///< e.g. "Improve"
    std::string session;      ///< as the client named it: any text; empty where there is none
    grpc::Status status;
    std::chrono::steady_clock::duration elapsed{};
};

/// Hears of every rpc at its end, from whatever thread. Must not block.
using RpcObserver = std::function<void(const RpcRecord&)>;

}  // namespace vsplit::rpc

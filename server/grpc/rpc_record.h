#pragma once

#include <grpcpp/support/status.h>

#include <chrono>
#include <functional>
#include <string>
#include <string_view>

#include "grpc/call_origin.h"

namespace vsplit::rpc {

/// One rpc that ended.
struct RpcRecord {
    std::string_view method;  ///< e.g. "Improve"
    std::string session;      ///< as the client named it: any text; empty where there is none
    grpc::Status status;
    std::chrono::steady_clock::duration elapsed{};
    std::string owner{};  ///< name of the token; empty where there is none
    CallOrigin origin{};  ///< without its authorization
};

/// Hears of every rpc at its end, from whatever thread. Must not block.
using RpcObserver = std::function<void(const RpcRecord&)>;

}  // namespace vsplit::rpc

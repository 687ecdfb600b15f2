#pragma once

#include <grpc/support/log.h>

#include <optional>
#include <string_view>

namespace vsplit::rpc {

/// Why a client's TLS failed, where this is what gRPC logs: it tells of that in no other way, and never whose it was.
[[nodiscard]] std::optional<std::string_view> tls_failure_in(const gpr_log_func_args& logged);

}  // namespace vsplit::rpc

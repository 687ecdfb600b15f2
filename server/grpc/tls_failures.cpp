#include "grpc/tls_failures.h"

namespace vsplit::rpc {

// E.g. "Handshake failed with fatal error SSL_ERROR_SSL: error:0A0000C7:SSL routines::peer did not return a certificate."
std::optional<std::string_view> tls_failure_in(const gpr_log_func_args& logged) {
    constexpr std::string_view kFile = "ssl_transport_security.cc", kBegin = "Handshake failed", kReason = "SSL routines:";
    std::string_view text = logged.message;
    if (!std::string_view(logged.file).ends_with(kFile) || !text.starts_with(kBegin)) return std::nullopt;
    const std::size_t reason = text.rfind(kReason);
    if (reason != std::string_view::npos) text.remove_prefix(reason + kReason.size());
    while (text.starts_with(':')) text.remove_prefix(1);
    while (text.ends_with('.') || text.ends_with('\n')) text.remove_suffix(1);
    return text;
}

}  // namespace vsplit::rpc

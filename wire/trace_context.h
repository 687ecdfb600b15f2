#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace vsplit::wire {

/// Metadata of calls, beside authorization.
inline constexpr const char* kRequestIdKey = "x-request-id";
inline constexpr const char* kTraceparentKey = "traceparent";
/// Whom a door of the server makes a call for. Believed of calls within the process only.
inline constexpr const char* kForwardedPeerKey = "vsplit-forwarded-peer";

/// Where a call stands in a trace: the W3C recommendation "Trace Context", its header traceparent.
struct TraceContext {
    std::string trace_id;  ///< 32 lower-case hexadecimal digits, not all 0
    std::string span_id;   ///< 16 of them, not all 0
    std::string flags;     ///< "01" when the caller records the trace, otherwise "00"
};

/// Empty for anything that is no traceparent, which is then as if it were not there. A version above 00 is read as 00.
[[nodiscard]] std::optional<TraceContext> parse_traceparent(std::string_view text);

[[nodiscard]] std::string to_traceparent(const TraceContext& trace);

/// Whether a client's own name of a request is taken: 1 to 64 of letters, digits, '.', '_' and '-'.
[[nodiscard]] bool is_request_id(std::string_view text);

}  // namespace vsplit::wire

#pragma once

#include <string>
#include <string_view>

#include "wire/trace_context.h"

namespace vsplit::rest {

/// By what a request is found again: in the log, in its answer (X-Request-Id), and in the rpcs that are made for it.
struct RequestMark {
    std::string id;            ///< the client's own name for it, or a new one
    wire::TraceContext trace;  ///< the client's trace, or a new one, with a span of its own
    std::string parent_span;   ///< empty where the trace begins here
    std::string peer;          ///< address of the client
};

/// The three texts are header fields and an address, as they came.
[[nodiscard]] RequestMark mark_request(std::string_view request_id, std::string_view traceparent, std::string peer);

}  // namespace vsplit::rest

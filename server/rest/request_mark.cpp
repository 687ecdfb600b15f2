#include "rest/request_mark.h"

#include <optional>
#include <utility>

#include "service/random_id.h"

namespace vsplit::rest {
namespace {

constexpr std::size_t kSpanDigits = 16;

std::string new_id() {
    const Expected<std::string> id = service::random_id();
    return id ? *id : std::string(32, '1');
}

}  // namespace

RequestMark mark_request(std::string_view request_id, std::string_view traceparent, std::string peer) {
    RequestMark mark;
    const std::string fresh = new_id();
    mark.id = wire::is_request_id(request_id) ? std::string(request_id) : fresh;
    const std::optional<wire::TraceContext> given = wire::parse_traceparent(traceparent);
    mark.trace = given ? *given : wire::TraceContext{new_id(), "", "00"};
    mark.parent_span = std::exchange(mark.trace.span_id, fresh.substr(0, kSpanDigits));
    mark.peer = std::move(peer);
    return mark;
}

}  // namespace vsplit::rest

#include "rest/freshness.h"

#include "rest/conditions.h"

namespace vsplit::rest {
namespace {

Condition condition_of(const Exchange& exchange, const std::string& etag) {
    if (etag.empty()) return Condition::kHolds;
    return judge(exchange.list(http::field::if_match), exchange.list(http::field::if_none_match), etag);
}

Problem another_one(const std::string& etag) {
    return http_problem(412, Cause::kInvalidOption, "what is here is not what If-Match names; it is " + etag, "If-Match");
}

}  // namespace

HeaderFields fields_of(const Freshness& freshness) {
    HeaderFields fields;
    if (!freshness.etag.empty()) fields.emplace_back("ETag", freshness.etag);
    if (!freshness.cache_control.empty()) fields.emplace_back("Cache-Control", freshness.cache_control);
    if (!freshness.vary.empty()) fields.emplace_back("Vary", freshness.vary);
    return fields;
}

Awaitable<bool> answer_condition(Exchange& exchange, const Freshness& freshness) {
    const Condition condition = condition_of(exchange, freshness.etag);
    if (condition == Condition::kHolds) co_return false;
    if (condition == Condition::kFailed) {
        co_await exchange.fail(another_one(freshness.etag));
        co_return true;
    }
    ResponseHead head;
    head.status = 304;
    head.fields = fields_of(freshness);
    if (!exchange.body().at_end()) exchange.response().close_after();
    co_await exchange.response().respond(head, {});
    co_return true;
}

}  // namespace vsplit::rest

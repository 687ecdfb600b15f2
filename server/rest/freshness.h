#pragma once

#include <string>

#include "rest/exchange.h"
#include "rest/header_fields.h"

namespace vsplit::rest {

/// By what a client knows whether what it holds is still good.
struct Freshness {
    std::string etag;           ///< strong, with its quotes; empty: nothing tells
    std::string cache_control;  ///< who may keep it, and for how long without asking
    std::string vary;           ///< request fields that decide which one is sent
};

[[nodiscard]] HeaderFields fields_of(const Freshness& freshness);

/// Answers a GET or HEAD that is answered by its conditions alone (If-Match, If-None-Match): 304, or a problem 412. False where
/// the body is to be sent.
Awaitable<bool> answer_condition(Exchange& exchange, const Freshness& freshness);

}  // namespace vsplit::rest

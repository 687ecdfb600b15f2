#pragma once

#include <google/protobuf/message.h>

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "rest/exchange.h"
#include "rest/json_budget.h"
#include "rest/router.h"

namespace vsplit::rest {

/// Where the bodies and messages of requests are made of and into JSON: large ones on threads of their own.
struct JsonWorks {
    const Schema& schema;
    Background& background;
    JsonBudget& budget;
};

/// Fills a request from path, query and, where the route has one, the JSON body, which is read to its end.
/// \return the request, or what it is refused for: LIMIT_EXCEEDED 413 or 429, UNSUPPORTED 415, MALFORMED_INPUT, INVALID_OPTION.
Awaitable<std::variant<std::unique_ptr<google::protobuf::Message>, Problem>> read_request(Exchange& exchange, const Route& route,
                                                                                          const Target& target, JsonWorks works);

/// Only what path and query say. \return INVALID_OPTION.
[[nodiscard]] Status bind_target(const Route& route, const Target& target, google::protobuf::Message& request);

/// A message as JSON. O(message).
Awaitable<std::string> write_json(const google::protobuf::Message& message, JsonWorks works);

/// Answers with a message as JSON; compressed where it is long and the client asks for that.
Awaitable<void> respond_json(Exchange& exchange, const google::protobuf::Message& message, JsonWorks works);

/// Whether the client takes JSON.
[[nodiscard]] bool accepts_json(const Exchange& exchange);

/// 406, naming what there is.
[[nodiscard]] Problem not_acceptable(std::string_view offered);

/// 415, naming what is taken.
[[nodiscard]] Problem wrong_body_type(const Exchange& exchange, std::string_view accepted);

/// 415 for a body that is compressed.
[[nodiscard]] std::optional<Problem> refuse_coding(const Exchange& exchange);

inline constexpr std::string_view kJsonType = "application/json";

}  // namespace vsplit::rest

#pragma once

#include <google/protobuf/message.h>

#include <string>
#include <string_view>

#include "vsplit/base/expected.h"

namespace vsplit::wire {

enum class JsonStyle { kLine, kIndented };
enum class UnknownFields { kRefused, kIgnored };

/// proto3 JSON: lowerCamelCase names, enums by name, 64-bit numbers as strings. Fields that hold their default are written too,
/// so that a script may rely on them; absent messages and absent optional fields are not. O(message).
[[nodiscard]] std::string to_json(const google::protobuf::Message& message, JsonStyle style = JsonStyle::kLine);

/// Fills `message` from proto3 JSON. \return INVALID_OPTION naming the field ("options.markedEdges[1]") that does not exist or
/// does not take its value, and what would be accepted; MALFORMED_INPUT with what the parser said for what is no JSON. O(text).
[[nodiscard]] Status from_json(std::string_view text, google::protobuf::Message& message,
                               UnknownFields unknown = UnknownFields::kRefused);

}  // namespace vsplit::wire

#pragma once

#include <google/protobuf/message.h>

#include <functional>
#include <string>
#include <string_view>

#include "vsplit/base/expected.h"
#include "wire/json_check.h"

namespace vsplit::wire {

enum class JsonStyle { kLine, kIndented };

/// proto3 JSON: lowerCamelCase names, enums by name, 64-bit numbers as strings. Fields that hold their default are written too,
/// so that a script may rely on them; absent messages and absent optional fields are not. O(message).
[[nodiscard]] std::string to_json(const google::protobuf::Message& message, JsonStyle style = JsonStyle::kLine);

/// Whether so much may be made of a text.
using AdmitJson = std::function<Status(const JsonSize&)>;

/// Fills `message` from proto3 JSON, enums as find_value has them; `admit` is asked before anything is made. \return what
/// check_json and `admit` return. O(text).
[[nodiscard]] Status from_json(std::string_view text, google::protobuf::Message& message,
                               UnknownFields unknown = UnknownFields::kRefused, const AdmitJson& admit = {});

}  // namespace vsplit::wire

#pragma once

#include <google/protobuf/message.h>

#include <string_view>

#include "vsplit/base/expected.h"

namespace vsplit::rest {

/// Sets the field that `name` leads to ("faces", "options.maxDeviation", "options.max_deviation") from text: numbers as JSON
/// writes them, enums as wire::find_value has it, or by number. A repeated field gets one more. What is no leaf takes a
/// type that JSON writes as a string (Duration, Timestamp).
/// \return INVALID_OPTION with the name as its field: no such field (and which there are), no such value (and what is accepted),
/// or another value than the field has already: what path, query and body say of a field must agree.
[[nodiscard]] Status set_field(google::protobuf::Message& message, std::string_view name, std::string_view text);

}  // namespace vsplit::rest

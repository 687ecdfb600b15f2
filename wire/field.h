#pragma once

#include <google/protobuf/descriptor.h>

#include <string>
#include <string_view>

#include "vsplit/base/error.h"

namespace vsplit::wire {

/// The field that a client calls `name`: as the contract writes it, or as JSON does; null where there is none. O(fields).
[[nodiscard]] const google::protobuf::FieldDescriptor* find_field(const google::protobuf::Descriptor& type,
                                                                  std::string_view name);

/// What one value of a field may be, in words: "a whole number from 0 to 4294967295", "one of AUTO, STL". A query and a JSON body
/// are told the same.
[[nodiscard]] std::string accepted_values(const google::protobuf::FieldDescriptor& field);

/// INVALID_OPTION: the field that the request calls `name` has a value that it does not take. `value` is quoted as it is, cut
/// where it is long.
[[nodiscard]] Error bad_value(std::string_view name, std::string_view value, const std::string& accepted);

/// INVALID_OPTION: messages of this type have no such field. `name` leads to it from the request on ("options.faecs"). Tells
/// which there are.
[[nodiscard]] Error unknown_field(std::string_view name, const google::protobuf::Descriptor& type);

}  // namespace vsplit::wire

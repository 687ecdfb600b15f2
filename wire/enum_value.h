#pragma once

#include <google/protobuf/descriptor.h>

#include <string>
#include <string_view>

/// What clients call the values of the contract's enums, at every door.
namespace vsplit::wire {

/// As names are compared: in small letters, with - for _. O(text).
[[nodiscard]] std::string folded(std::string_view text);

/// The engine's own name of a format or a unit of length ("3mf", "mm") where that is not the value's name, folded; else empty.
[[nodiscard]] std::string_view symbol_of(const google::protobuf::EnumValueDescriptor& value);

/// The value that is called so, by its name or its symbol, in any case and with - for _; null where there is none. O(values).
[[nodiscard]] const google::protobuf::EnumValueDescriptor* find_value(const google::protobuf::EnumDescriptor& type,
                                                                      std::string_view text);

}  // namespace vsplit::wire

#pragma once

#include <google/protobuf/descriptor.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <variant>

namespace vsplit::wire {

/// A JSON value that is no object and no list.
using JsonScalar = std::variant<std::nullptr_t, bool, std::int64_t, std::uint64_t, double, std::string>;

/// Whether proto3 JSON takes the value for a field of this type, which is no message. Null is none. O(value).
[[nodiscard]] bool takes_value(const google::protobuf::FieldDescriptor& field, const JsonScalar& value);

/// As messages quote it.
[[nodiscard]] std::string text_of(const JsonScalar& value);

}  // namespace vsplit::wire

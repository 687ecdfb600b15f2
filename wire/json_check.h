#pragma once

#include <google/protobuf/descriptor.h>

#include <cstdint>
#include <string>
#include <string_view>

#include "vsplit/base/expected.h"

namespace vsplit::wire {

/// How much a JSON text makes of itself.
struct JsonSize {
    std::uint64_t messages = 0;  ///< objects
    std::uint64_t values = 0;    ///< numbers, texts, true, false and null
    bool respelled = false;      ///< whether a value of an enum is called otherwise than protobuf calls it
};

enum class UnknownFields { kRefused, kIgnored };

/// Reads proto3 JSON of `type` without making anything of it. \return INVALID_OPTION naming the field ("options.markedEdges[1]")
/// that does not exist, is there twice, excludes another that is there or does not take its value, and what would be accepted;
/// MALFORMED_INPUT saying where for what is no JSON or no object. O(text), memory O(depth).
[[nodiscard]] Expected<JsonSize> check_json(std::string_view text, const google::protobuf::Descriptor& type,
                                            UnknownFields unknown);

/// The same text with every value of an enum called as protobuf calls it. \pre check_json accepts the text. O(text).
[[nodiscard]] std::string respell_json(std::string_view text, const google::protobuf::Descriptor& type);

}  // namespace vsplit::wire

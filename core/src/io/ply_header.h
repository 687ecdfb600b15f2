#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "io/number_kind.h"
#include "io/read_error.h"
#include "vsplit/base/expected.h"

namespace vsplit {

enum class PlyEncoding { kAscii, kLittleEndian, kBigEndian };

using PlyType = NumberKind;

struct PlyProperty {
    std::string name;
    bool is_list = false;
    PlyType count_type{};  ///< of a list's length
    PlyType type{};
};

struct PlyElement {
    std::string name;
    std::uint64_t count = 0;
    std::vector<PlyProperty> properties;
    std::size_t line = 0;  ///< where the header announces it

    /// The fewest bytes a row can take, lists being empty.
    [[nodiscard]] std::size_t least_bytes(PlyEncoding encoding) const;
};

struct PlyHeader {
    PlyEncoding encoding{};
    std::vector<PlyElement> elements;
    std::size_t lines = 0;        ///< of the header, "end_header" included
    std::size_t body_offset = 0;  ///< byte at which the first row begins
};

/// \return TRUNCATED_INPUT, MALFORMED_INPUT with the line.
[[nodiscard]] Expected<PlyHeader> parse_ply_header(std::string_view text);

}  // namespace vsplit

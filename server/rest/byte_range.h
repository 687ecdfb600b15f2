#pragma once

#include <cstdint>
#include <string_view>

namespace vsplit::rest {

/// The part of a file that a Range header asks for.
struct ByteRange {
    enum class Kind {
        kWhole,          ///< no header, or one that is passed over: another unit, several ranges, no range at all
        kPart,           ///< bytes [first, last]
        kUnsatisfiable,  ///< begins behind the end
    };
    Kind kind = Kind::kWhole;
    std::uint64_t first = 0;
    std::uint64_t last = 0;
};

/// RFC 9110 14.2 for a file of `size` bytes. O(header).
[[nodiscard]] ByteRange parse_range(std::string_view header, std::uint64_t size);

}  // namespace vsplit::rest

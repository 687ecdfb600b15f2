#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "io/read_error.h"
#include "vsplit/base/expected.h"

namespace vsplit {

/// How the arrays of a VTU file are written.
struct VtuEncoding {
    std::endian order = std::endian::little;
    std::size_t header = 4;      ///< bytes of a length: 4 or 8
    bool zlib = false;           ///< in blocks that zlib has compressed
    std::size_t most_bytes = 0;  ///< of an array after that: more is an error
};

/// The bytes of an array that begins at the front of `bytes`, as text of base64 or as they are.
/// \return TRUNCATED_INPUT, MALFORMED_INPUT, LIMIT_EXCEEDED at `place`.
[[nodiscard]] Expected<std::vector<std::byte>> decode_vtu_array(std::string_view bytes, bool base64, const VtuEncoding& encoding,
                                                                Place place);

}  // namespace vsplit

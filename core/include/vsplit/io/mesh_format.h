#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

#include "vsplit/base/expected.h"

namespace vsplit {

/// Mesh files that are read and written. Reading tells kStlBinary from kStlAscii, and the kinds of PLY apart, by the bytes.
enum class MeshFormat {
    kStlBinary,
    kStlAscii,
    kObj,
    kPlyBinary,  ///< little-endian when written; both byte orders are read
    kPlyAscii,
    kOff,
};

/// "stl", "stl-ascii", "obj", "ply", "ply-ascii", "off".
[[nodiscard]] std::string_view format_name(MeshFormat format);

/// The inverse of format_name. \return INVALID_OPTION listing the names.
[[nodiscard]] Expected<MeshFormat> format_by_name(std::string_view name);

/// By the extension of a file's name (".stl" is binary), in any case. \return UNKNOWN_FORMAT listing the extensions.
[[nodiscard]] Expected<MeshFormat> format_by_extension(std::string_view file_name);

/// By the bytes themselves; a binary STL whose header begins with "solid" is told by its length.
/// Empty when no format fits. O(1): looks at the first few KiB and the length.
[[nodiscard]] std::optional<MeshFormat> detect_format(std::span<const std::byte> bytes);

}  // namespace vsplit

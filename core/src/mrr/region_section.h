#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "vsplit/base/expected.h"
#include "vsplit/mrr/multires_mesh.h"

namespace vsplit {

/// What follows the records of a `.vsplit` file where the mesh has regions (docs/format.md); empty where it has none.
[[nodiscard]] std::string encode_regions(const MultiresMesh& mrr);

/// Reads it into `mrr`, which has its base and records. `at`: where the bytes stand in the file.
/// \return TRUNCATED_INPUT, CORRUPT with the byte offset.
[[nodiscard]] Status decode_regions(std::span<const std::byte> bytes, std::size_t at, MultiresMesh& mrr);

}  // namespace vsplit

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "vsplit/base/expected.h"
#include "vsplit/mrr/position_grid.h"

namespace vsplit {

/// The base mesh as a client of an encoding other than kFloat64 gets it (docs/format.md): about 4 bytes a vertex at 14 bits when
/// its faces go as `walk_faces` does, as those of every MRR this library makes do; about 12 where not.
/// \pre `base` is a closed manifold, its positions on `grid`, which is not kFloat64. O(vertices + faces).
[[nodiscard]] std::string pack_base(const TriangleMesh& base, std::uint32_t ghosts, const PositionGrid& grid);

/// The way back, bit for bit. `vertices`, `faces` and `ghosts` are as announced. \return CORRUPT, with what is wrong. Memory
/// grows with the bytes that are there, at most about 100 times. Whether the mesh is closed is for ProgressiveMesh::from_base to
/// say.
struct PackedBase {
    std::span<const std::byte> bytes;
    std::uint32_t vertices = 0;
    std::uint32_t faces = 0;
    std::uint32_t ghosts = 0;
};
[[nodiscard]] Expected<TriangleMesh> unpack_base(const PackedBase& packed, const PositionGrid& grid);

}  // namespace vsplit

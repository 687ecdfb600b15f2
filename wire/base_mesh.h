#pragma once

#include <cstddef>
#include <cstdint>

#include "vsplit/base/expected.h"
#include "vsplit/mesh/triangle_mesh.h"
#include "vsplit/mrr/position_grid.h"
#include "vsplit/v1/meshing.pb.h"

namespace vsplit::wire {

/// No part of a base mesh has more data.
inline constexpr std::size_t kMaxPartBytes = std::size_t{256} * 1024;

/// Parts that base_mesh_part cuts a mesh into: vertices first, then faces. O(1).
[[nodiscard]] std::size_t base_mesh_parts(const TriangleMesh& mesh);

/// Part number `part` of a mesh whose first `ghosts` vertices are ghosts (see MultiresMesh). \pre part < base_mesh_parts(mesh).
/// O(kMaxPartBytes).
[[nodiscard]] v1::BaseMesh base_mesh_part(const TriangleMesh& mesh, std::size_t part, std::uint32_t ghosts = 0);

/// A base mesh as pack_base makes it, and what its client must know to read it.
struct PackedBaseMesh {
    std::string bytes;
    std::uint32_t crc32c = 0;
    std::uint32_t vertices = 0;
    std::uint32_t faces = 0;
    std::uint32_t ghosts = 0;
    PositionGrid grid;
    double max_error = 0;  ///< of any coordinate of the stream, model units
};

/// That of `mrr`, which pack_base made `bytes` of. \pre grid is not of kFloat64. O(bytes).
[[nodiscard]] PackedBaseMesh packed_base_mesh(const MultiresMesh& mrr, const PositionGrid& grid, std::string bytes,
                                              double max_error);

[[nodiscard]] std::size_t base_mesh_parts(const PackedBaseMesh& base);

/// \pre part < base_mesh_parts(base). O(kMaxPartBytes).
[[nodiscard]] v1::BaseMesh base_mesh_part(const PackedBaseMesh& base, std::size_t part);

/// Puts a base mesh together from its parts. What arrives is checked before it is kept: order, sizes, the limit; memory grows
/// with the bytes that have come, never with the counts that a part claims. Indices, coordinates and ghosts are
/// for ProgressiveMesh::from_base to check.
class BaseMeshAssembler {
public:
    explicit BaseMeshAssembler(std::uint32_t max_faces = 50'000'000) : max_faces_(max_faces) {}

    /// \return OUT_OF_ORDER for a part that does not follow the one before it; CORRUPT for bytes or counts that do not fit;
    /// LIMIT_EXCEEDED for more than `max_faces` faces or vertices. After an error the assembler is of no further use.
    [[nodiscard]] Status add(const v1::BaseMesh& part);

    /// Whether all parts have come.
    [[nodiscard]] bool complete() const { return complete_; }

    /// The mesh, given away, once. \pre complete().
    [[nodiscard]] TriangleMesh take();

    /// How many of its first vertices are ghosts, as the first part said.
    [[nodiscard]] std::uint32_t ghosts() const { return ghosts_; }

    /// The positions that the stream has, and by how much they may be off, as the first part said.
    [[nodiscard]] const PositionGrid& grid() const { return grid_; }
    [[nodiscard]] double max_error() const { return max_error_; }
    /// Of a keyframe the number of the first record that it has not in it, as the first part said; otherwise 0.
    [[nodiscard]] std::uint32_t first_record() const { return first_record_; }
    /// How many splits the stream means to bring, as the first part said.
    [[nodiscard]] std::uint32_t splits() const { return splits_; }

private:
    [[nodiscard]] Status check_counts(const v1::BaseMesh& part);
    [[nodiscard]] Status check_order(const v1::BaseMesh& part) const;
    [[nodiscard]] Status check_bytes(const v1::BaseMesh& part) const;
    [[nodiscard]] Status begin(const v1::BaseMesh& part);
    [[nodiscard]] Status add_packed(const v1::BaseMesh& part);
    [[nodiscard]] Status unpack(const v1::BaseMesh& part);

    std::uint32_t max_faces_;
    std::uint32_t vertices_ = 0;
    std::uint32_t faces_ = 0;
    std::uint32_t ghosts_ = 0;
    bool begun_ = false;
    bool complete_ = false;
    PositionGrid grid_;
    double max_error_ = 0;
    std::uint32_t first_record_ = 0;
    std::uint32_t splits_ = 0;
    std::string packed_;
    TriangleMesh mesh_;
};

}  // namespace vsplit::wire

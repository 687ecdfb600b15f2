#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>

#include "service/bounded_work.h"
#include "service/kept.h"
#include "service/limits.h"
#include "vsplit/base/expected.h"
#include "vsplit/io/mesh_format.h"
#include "vsplit/mesh/inspect.h"
#include "vsplit/mesh/triangle_mesh.h"
#include "vsplit/repair/repair_mesh.h"

namespace vsplit::service {

/// How an uploaded file is to be read.
struct MeshSettings {
    std::optional<MeshFormat> format;       ///< told from the bytes when empty
    double weld = 0;                        ///< length, model units; 0 merges exactly equal vertices
    std::optional<RepairOptions> repair{};  ///< after the weld; none when empty
    std::optional<LengthUnit> unit{};       ///< of the lengths, where the file does not say it
};

/// Whether `settings` can be obeyed, before any byte is there. \return INVALID_OPTION. O(1).
[[nodiscard]] Status check_settings(const MeshSettings& settings);

/// What a session's methods begin with: a mesh that could be read, open and non-manifold ones included. Never changes; the mesh
/// is in memory while there is room.
struct SourceMesh {
    std::shared_ptr<Kept<TriangleMesh>> mesh;
    MeshReport report;
};

/// With a mesh that is in memory and nowhere else. `budget` outlives it.
[[nodiscard]] std::shared_ptr<const SourceMesh> make_source(TriangleMesh mesh, MeshReport report, MemoryBudget& budget);

/// Reads, welds, repairs and inspects. Heavy: for a worker, not for a thread that others wait for.
/// \return what `read_mesh` returns; LIMIT_EXCEEDED names the server's limit; CANCELLED where it is not `wanted` any more.
[[nodiscard]] Expected<std::shared_ptr<const SourceMesh>> read_source(std::span<const std::byte> bytes,
                                                                      const MeshSettings& settings, const Limits& limits,
                                                                      MemoryBudget& budget,
                                                                      const StillWanted& wanted = always_wanted);

}  // namespace vsplit::service

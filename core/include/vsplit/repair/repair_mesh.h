#pragma once

#include <optional>
#include <vector>

#include "vsplit/base/execution_context.h"
#include "vsplit/base/expected.h"
#include "vsplit/mesh/finding.h"
#include "vsplit/mesh/inspect.h"
#include "vsplit/mesh/triangle_mesh.h"
#include "vsplit/mesh/weld.h"

namespace vsplit {

/// How far a repair may go.
enum class RepairMode {
    kNone,  ///< changes nothing; says what stands in the way
    kSafe,  ///< the surface stays the same set of points but walls of no thickness: weld, drop, turn, cut apart
    kFull,  ///< closes it too: stitches cracks, drops specks, fills small holes
};

/// Lengths in model units, all >= 0 and finite.
struct RepairOptions {
    RepairMode mode = RepairMode::kNone;
    double weld = 0;                    ///< SAFE, FULL: vertices this close become one; 0 merges equal ones
    std::optional<double> stitch{};     ///< FULL: borders this close are joined; default 0.2 % of the diagonal
    std::optional<double> hole_size{};  ///< FULL: holes with a box of at most this diagonal are filled; default 5 % of the mesh's
    std::optional<double> speck_size{};  ///< FULL: pieces with a box of a smaller diagonal are dropped, the largest aside;
                                         ///< default 0.1 % of the mesh's
};

/// A repaired mesh, and what was done to it.
struct RepairedMesh {
    TriangleMesh mesh;
    /// Of each face: the face of the input it is, or is a part of; of a filled hole a face beside it. It has that one's region;
    /// but one that copies were dropped of is in their sets too, and may have a region that is new for that.
    std::vector<std::uint32_t> parent;
    /// First what was changed, by kind, each change with a place; `elements` are faces of the input. Then what still stands in
    /// the way, as `inspect` says it, and pairs of faces that intersect (never repaired); there `elements` are of `mesh`.
    std::vector<Finding> findings;
};

/// Whether `options` can be obeyed: lengths are such, and those of FULL are given with it alone. \return INVALID_OPTION naming
/// the field.
[[nodiscard]] Status check_options(const RepairOptions& options);

/// Makes a manifold of a mesh that is none, and with FULL a closed one where its holes are small.
///
/// In this order, each change counted:
/// 1. MERGED_VERTEX: `weld`. DROPPED_FACE: faces with two equal corners.
/// 2. DROPPED_DUPLICATE: faces on the same three vertices: one of those that look the same way is kept; of two that look opposite
///    ways neither where the edges around them stay closed without (a wall of no thickness); else the one that agrees with its
///    neighbours, and of a sheet that no other face touches one. The kept one goes into the sets of the others; LOST_FACE: what
///    a region in no set, or a wall's, loses by that. EMPTIED_GROUP: a set, or region in no set, that has no face in the end.
/// 3. FULL: STITCHED_VERTEX: vertices on borders become one with near ones, or are put into near border edges, the closest first;
///    so patches that were tessellated apart, with T-junctions, become one ([Date05] refs. 20, 21).
/// 4. TURNED_FACE: neighbours agree on a side; as few as possible of a piece are turned; FULL: a closed mesh encloses a volume.
/// 5. SPLIT_EDGE, SPLIT_VERTEX: at an edge of more than two faces those with the body between them stay together; a vertex of
///    several fans becomes several, at the same place. Where both ends of such an edge stay whole, it gets a vertex in its
///    middle.
/// 6. FLATTENED_FACE: faces without area are flipped or contracted away; those that hang on others by an edge, before 4.
/// 7. FULL: DROPPED_SPECK, FILLED_HOLE: by the triangulation of least area; the only or outer border of a piece is no hole.
///    Then step 6 again, for holes along a line.
///
/// \pre every index is below the number of vertices, coordinates are finite.
/// \return what `check_options` returns; CANCELLED.
/// Complexity: O(n log n), holes cubic in their edges (of at most 500). Deterministic.
[[nodiscard]] Expected<RepairedMesh> repair_mesh(const TriangleMesh& mesh, const RepairOptions& options,
                                                 const ExecutionContext& context = ExecutionContext());

/// What everybody does with a mesh just read: inspects it; where a repair is asked for, puts the repaired mesh in its place
/// first. \return CANCELLED. The report's findings are the repair's, then what `weld` dropped. Without a repair nothing looks for
/// self-intersections.
[[nodiscard]] Expected<MeshReport> inspect_source(TriangleMesh& mesh, const WeldCounts& weld,
                                                  const std::optional<RepairOptions>& repair,
                                                  const ExecutionContext& context = ExecutionContext());

}  // namespace vsplit

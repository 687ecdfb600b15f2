#pragma once

#include "repair/draft.h"
#include "vsplit/base/execution_context.h"

namespace vsplit {

/// The steps of `repair_mesh`, which says what each does. All are deterministic; those that take a
/// context leave the draft somewhere on the way when it is cancelled.

/// Of faces on the same three vertices that look opposite ways none is kept where that leaves closed what is around them, a wall;
/// else the one that agrees with its neighbours. O(faces log faces).
void drop_duplicates(Draft& draft);

/// Joins borders no further apart than `tolerance` (length), the closest first. \pre tolerance > 0.
void stitch_borders(Draft& draft, double tolerance, const ExecutionContext& context);

/// Makes faces agree across edges of two faces; fewest turned in a piece. What cannot agree (a Moebius band) stays. O(faces log
/// faces).
void orient_faces(Draft& draft);

/// Turns every face when the mesh is closed and encloses a negative volume. \pre manifold.
void face_outward(Draft& draft);

/// Cuts edges and vertices apart until the mesh is a manifold; only copies of vertices and midpoints of edges are new. O(faces
/// log faces).
void split_non_manifold(Draft& draft);

/// Drops faces of stretch under 1e-9 that only hang on others: two of their edges or more have an odd number of faces.
/// O(faces log faces).
void drop_hanging_needles(Draft& draft);

/// Flips or contracts away faces of stretch under 1e-9 where neighbours allow. \pre manifold; may leave vertices of two fans
/// where such a face lay at a border.
void remove_degenerate(Draft& draft);

/// Drops pieces, connected by shared edges, whose box has a diagonal under `size`; never all. O(faces log faces).
void drop_specks(Draft& draft, double size);

/// Fills holes whose box has a diagonal of at most `size`. \pre manifold. See `repair_mesh`.
void fill_holes(Draft& draft, double size, const ExecutionContext& context);

/// Counts the sets, and the regions in no set, that have faces in `input` and none in the draft. O(faces log faces + members of
/// sets).
void report_emptied_groups(Draft& draft, const TriangleMesh& input);

}  // namespace vsplit

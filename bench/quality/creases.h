#pragma once

#include <vector>

#include "quality/distance.h"
#include "vsplit/mesh/triangle_mesh.h"

namespace vsplit::bench {

/// The edges whose two faces' normals differ by more than `angle` degrees. Rounding in slivers makes none (see `face_normals`).
[[nodiscard]] std::vector<Segment> sharp_segments(const TriangleMesh& mesh, double angle);

/// The edges that have not exactly two faces.
[[nodiscard]] std::vector<Segment> border_segments(const TriangleMesh& mesh);

}  // namespace vsplit::bench

#pragma once

#include <cstddef>
#include <optional>

#include "vsplit/quality/mesh_quality.h"

namespace vsplit::bench {

struct MeasureOptions {
    std::size_t samples = 200'000;  ///< points a side for the deviation, and along the creases; >= 1
    double crease_angle = 40;       ///< degrees, 0..180: sharper edges are creases; borders always are
    double near = 0.2;              ///< % of the source's diagonal: a crease this far from where it was is kept
};

/// What the comparison with other remeshers is about.
/// What has to do with creases is empty where the source has none.
struct Figures {
    Quality quality;
    double deviation = 0;  ///< two-sided distance at samples and all vertices, % of the source's diagonal; 0 below 1e-7
    std::optional<double> crease_lost;   ///< % of the source's creases further than `near` from any of the result
    std::optional<double> crease_gone;   ///< the same, from any edge of the result of half the angle: not even a bend is left
    std::size_t folds = 0;               ///< edges whose faces look opposite ways (cosine < -0.9), none such near in the source
    std::size_t self_intersections = 0;  ///< see find_self_intersections
    std::size_t source_self_intersections = 0;  ///< of the source
    std::size_t border_edges = 0;               ///< edges without exactly two faces
};

/// O((samples + faces) log faces). The same figures every time: the samples are spread by fixed rules.
/// \pre both meshes have faces and valid indices.
[[nodiscard]] Figures measure(const TriangleMesh& result, const TriangleMesh& source, const MeasureOptions& options = {});

}  // namespace vsplit::bench

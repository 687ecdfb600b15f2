#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "vsplit/mesh/triangle_mesh.h"

namespace vsplit {

/// A face and its figures.
struct FaceQuality {
    std::uint32_t face = 0;
    double stretch = 0;
    double size = 0;
    Vec3 centroid = Vec3::Zero();
};

/// Shape, size and valence of a whole mesh.
struct Quality {
    std::uint32_t faces = 0;
    double stretch_min = 0;
    double stretch_mean = 0;
    double stretch_p01 = 0;                             ///< 1st percentile: the stretch of the face at rank floor(faces / 100)
    std::uint32_t faces_below_02 = 0;                   ///< faces with stretch < 0.2
    double size_max = 0;                                ///< longest edge, model units
    std::uint32_t valence_max = 0;                      ///< most edges at one vertex
    std::array<std::uint32_t, 20> stretch_histogram{};  ///< faces with stretch in [i/20, (i+1)/20); 1 counts in the last
    std::optional<double> deviation_max;                ///< measured two-sided distance to the source; empty when not measured
    /// Of the source's creases (those the method used) to the result's; empty when not measured or where the source has none. An
    /// upper bound that is certain, over a distance that is attained by 2 % or 1e-5 of the diagonal at most, whichever is more.
    /// The result's creases are its edges that bend by more than half of feature_angle, and its boundary; for a crease of the
    /// source that bends less itself (marked, a border of regions, voted for), all its edges. Infinite where it has none.
    std::optional<double> crease_deviation_max;
};

/// O(faces log faces) time; an empty mesh has all figures 0.
[[nodiscard]] Quality measure_quality(const TriangleMesh& mesh);

/// The `count` faces of least stretch, worst first, ties by index. O(faces log count).
[[nodiscard]] std::vector<FaceQuality> worst_faces(const TriangleMesh& mesh, std::size_t count);

}  // namespace vsplit

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "vsplit/mesh/triangle_mesh.h"

namespace vsplit {

/// A face may turn by at most acos of this: 78 degrees.
inline constexpr double kLeastTurnCosine = 0.2;

/// A fan as structure of arrays, so that its faces are evaluated as vectors; see Fan.
struct FanColumns {
    static constexpr std::size_t kFaces = 64;
    // One more than faces, rounded up to whole vectors, and a vector beyond. What stands behind the end of a fan is read and
    // means nothing.
    static constexpr std::size_t kRows = kFaces + 8;
    template <class Number>
    using Column = std::array<Number, kRows>;

    Column<double> x{}, y{}, z{};                ///< of the ring
    Column<double> ring{};                       ///< lengths from each ring vertex to the next
    Column<double> spoke{};                      ///< lengths from the apex to each ring vertex
    Column<double> stretch{}, face_size{};       ///< of the faces
    Column<float> old_nx{}, old_ny{}, old_nz{};  ///< normals of the faces as they were
};

/// What a fan would be with its vertex at a place.
struct FanShape {
    double stretch_min = 0;
    double stretch_sum = 0;
    double size_max = 0;
    bool folds = false;  ///< some face would turn its normal by more than about 78 degrees, or lose its area
};

/// Fills `spoke`, `stretch` and `face_size` for the apex at a place, and `ring` where `measure`. Takes the widest vectors of at
/// most four numbers that the machine has; the bits are the same with any. \pre 1 to kFaces faces. O(faces).
[[nodiscard]] FanShape shape_fan(FanColumns& fan, std::size_t faces, const Vec3& apex, bool measure);

// For tests: which kinds of vectors the machine at hand offers, and to go by one of them alone; by 0 for the best again. Not
// while another thread works.
[[nodiscard]] std::vector<std::int64_t> simd_paths();
[[nodiscard]] const char* simd_path_name(std::int64_t path);
void use_simd_path(std::int64_t path);

}  // namespace vsplit

#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "vsplit/base/expected.h"
#include "vsplit/mesh/triangle_mesh.h"

namespace vsplit {

inline constexpr double kDefaultGradation = 0.3;
/// Sizes that grow faster than distance would let a large face pass over a small sphere in its middle unseen.
inline constexpr double kLargestGradation = 1;

/// Spheres and boxes together: each is evaluated at every vertex.
inline constexpr std::size_t kMostShapes = 1000;

/// No edge in the ball is longer than `size`.
struct SizeSphere {
    Vec3 center = Vec3::Zero();
    double radius = 0;  ///< length, >= 0; 0 is a point
    double size = 0;    ///< length, > 0

    friend bool operator==(const SizeSphere&, const SizeSphere&) = default;
};

/// No edge in the axis-aligned box is longer than `size`.
struct SizeBox {
    Vec3 min = Vec3::Zero();
    Vec3 max = Vec3::Zero();  ///< nowhere below min
    double size = 0;          ///< length, > 0

    friend bool operator==(const SizeBox&, const SizeBox&) = default;
};

/// How long edges may be where on the surface: the least of everything given here. Lengths in model units.
struct SizingOptions {
    std::vector<SizeSphere> spheres{};    ///< with the boxes at most kMostShapes; default none
    std::vector<SizeBox> boxes{};         ///< default none
    std::optional<double> chord_error{};  ///< length, > 0: a chord of the size lies no further from a circle of the surface's
                                          ///< largest curvature, sqrt(8 r chord_error); default none
    std::vector<double> field{};          ///< one a vertex of the source, length, >= 0; 0 is no bound. Default none
    double gradation =
        kDefaultGradation;             ///< > 0, at most 1: the size grows by at most this per unit of length along the surface
    std::optional<double> min_size{};  ///< length, > 0: no size is less, whatever asks for it; default none
    std::optional<double> max_size{};  ///< length, > 0, at least min_size; default none

    friend bool operator==(const SizingOptions&, const SizingOptions&) = default;
};

/// Ranges and contradictions. `max_size` is the method's own bound, if it has one, for the contradiction of min_size.
/// \return INVALID_OPTION whose field is "sizing." and the member, naming the element at fault, what it was and what would be
/// accepted. O(size of the options).
[[nodiscard]] Status check_sizing(const SizingOptions& options, std::optional<double> max_size = {});

/// Whether `field` fits `mesh`. \return INVALID_OPTION (field "sizing.field") saying how many numbers would be accepted. O(1).
[[nodiscard]] Status check_sizing_on(const TriangleMesh& mesh, const SizingOptions& options);

}  // namespace vsplit

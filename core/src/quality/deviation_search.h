#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>

#include "spatial/surface_index.h"
#include "vsplit/quality/deviation.h"

namespace vsplit {

/// What is measured from: faces or edges over the vertices of a mesh.
template <class Shape>
struct ShapesOf {
    std::span<const Vec3> positions;
    std::span<const std::array<std::uint32_t, Shape::kCorners>> elements;
};

/// DeviationOptions with the defaults filled in.
struct SearchLimits {
    double relative_error = 0;
    double absolute_error = 0;
    std::uint64_t evaluations = 0;
};

/// Hears how far a search is, 0 to 1 and never less than before.
using SearchProgress = std::function<void(double fraction)>;

/// The largest distance from the points of `from` to `to`, as described at measure_deviation. Uses the threads of the arena it
/// is called in; progress is told between batches of work. \return CANCELLED.
template <class Shape>
[[nodiscard]] Expected<DirectedDeviation> directed_deviation(const ShapesOf<Shape>& from, const ShapeIndex<Shape>& to,
                                                             const SearchLimits& limits, const ExecutionContext& context,
                                                             const SearchProgress& progress);

extern template Expected<DirectedDeviation> directed_deviation(const ShapesOf<TriangleShape>&, const SurfaceIndex&,
                                                               const SearchLimits&, const ExecutionContext&,
                                                               const SearchProgress&);
extern template Expected<DirectedDeviation> directed_deviation(const ShapesOf<SegmentShape>&, const CreaseIndex&,
                                                               const SearchLimits&, const ExecutionContext&,
                                                               const SearchProgress&);

}  // namespace vsplit

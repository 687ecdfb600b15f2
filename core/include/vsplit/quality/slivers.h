#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "vsplit/features/sharp_edges.h"
#include "vsplit/mesh/triangle_mesh.h"

namespace vsplit {

/// What forces a face to be a sliver.
enum class SliverCause {
    kNarrowStrip,    ///< two creases closer to each other than the floor allows for edges this long
    kSharpCorner,    ///< two creases that meet at an angle below what the floor needs
    kCloseCorners,   ///< two corners of creases (ends, meetings, turns over 40 degrees) as close
    kNarrowPart,     ///< the part itself, a tube or rod, is as narrow there: so far around, across the face's longest edge
    kDeviation,      ///< each flip or collapse that would mend it moves the surface by more than max_deviation
    kHeldByCreases,  ///< flips or collapses would mend it, but each costs a crease or takes it from where the source has one
    kUnexplained,    ///< nothing of these
};

/// e.g. "NARROW_STRIP".
[[nodiscard]] std::string_view sliver_cause_name(SliverCause cause);

/// Faces under the floor that have one cause.
struct Slivers {
    static constexpr std::size_t kExamples = 16;

    SliverCause cause = SliverCause::kUnexplained;
    std::uint32_t count = 0;
    double least = 0;  ///< distance of the creases or corners; angle in degrees; girth; what a mend would move; HELD_BY_CREASES,
                       ///< UNEXPLAINED: the stretch
    double most = 0;   ///< the same, of the face where it is most
    std::vector<std::uint32_t> elements;  ///< the first kExamples faces
    std::string message;                  ///< one sentence
};

struct SliverOptions {
    double edge = 0;           ///< length of edges wanted; >= 0. 0: the mean edge. A longer edge explains no sliver by its length
    double max_deviation = 0;  ///< length; >= 0. 0: no bound, so none explains anything
    double crease_angle = 0;   ///< degrees, 0..180: creases that bend by more have to go on doing so. 0: none has to
};

/// Why each face with a stretch under kStretchFloor (0.2) is one: the first cause that holds, a sharp corner before a strip, the
/// rest in their order. One entry a cause, in order; empty where there is no sliver.
///
/// With L the longest edge of a face, or `edge` where that is less, the bounds are those at which the best triangle just reaches
/// the floor: a strip 0.117 L wide, corners 0.123 L apart, an angle of 7.0 degrees, a girth of 0.234 L. Boundary edges belong
/// among the creases. What is found holds for faces of this size: many smaller ones could fill a strip better. \pre `mesh` is
/// manifold; `creases` are edges of it. O(faces) where there are slivers, else only the time to look; O(valence^2) a sliver.
[[nodiscard]] std::vector<Slivers> explain_slivers(const TriangleMesh& mesh, const std::vector<SharpEdge>& creases,
                                                   const SliverOptions& options);

}  // namespace vsplit

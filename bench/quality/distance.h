#pragma once

#include <array>
#include <memory>
#include <vector>

#include "vsplit/mesh/triangle_mesh.h"

namespace vsplit::bench {

using Segment = std::array<Vec3, 2>;

/// How far points are from a surface or from a set of segments. The one place of the bench that searches for nearest points.
class Distance {
public:
    explicit Distance(const TriangleMesh& surface);
    explicit Distance(const std::vector<Segment>& segments);
    ~Distance();
    Distance(const Distance&) = delete;
    Distance& operator=(const Distance&) = delete;

    /// Infinite when there is nothing to be near to. The search ends at the first thing within `enough`, so that a distance up to
    /// `enough` may be given too large, but never beyond `enough`.
    [[nodiscard]] double distance(const Vec3& point, double enough = 0) const;

private:
    class Tree;
    std::unique_ptr<const Tree> tree_;
};

}  // namespace vsplit::bench

#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "spatial/shapes.h"

namespace vsplit {

/// The nearest of many shapes to any point: a bounding-volume hierarchy of four children a node, over copies of the shapes.
/// Immutable; any number of threads may ask. About 200 bytes a triangle, 100 a segment.
template <class Shape>
class ShapeIndex {
public:
    using Prepared = typename Shape::Prepared;

    static constexpr std::uint32_t kNoElement = 0xFFFFFFFFU;

    struct Hit {
        double squared_distance = std::numeric_limits<double>::infinity();
        Vec3 point = Vec3::Zero();
        std::uint32_t element = kNoElement;  ///< index of the shape; of several equally near the smallest
        std::uint32_t tests = 0;             ///< shapes that were looked at: many where boxes say little, as of needles
    };

    /// O(shapes log shapes), in parallel; the same tree for any number of threads. \pre coordinates are finite, under 1e15 in
    /// size; fewer than 2^32 - 1 shapes.
    explicit ShapeIndex(std::vector<Shape> shapes);

    [[nodiscard]] std::size_t size() const { return shapes_.size(); }
    [[nodiscard]] bool empty() const { return shapes_.empty(); }
    /// The shape of this index in what the constructor was given.
    [[nodiscard]] const Prepared& shape(std::uint32_t element) const { return shapes_[slot_[element]]; }

    /// The nearest point of all shapes that are no further from `p` than the root of `upper_squared`, a hint that saves most of
    /// the search where it is good; no element where there is none. Typically O(log shapes).
    [[nodiscard]] Hit closest(const Vec3& p, double upper_squared = std::numeric_limits<double>::infinity()) const {
        return search(p, upper_squared, -1);
    }

    /// The same, `hint` being the index of a shape to try first, or any other number; becomes that of the shape found.
    [[nodiscard]] bool within(const Vec3& p, double distance, std::uint32_t& hint) const {
        if (hint < size() && shape(hint).closest(p).squared_distance <= distance * distance) return true;
        const Hit hit = search(p, distance * distance, distance * distance);
        if (hit.element != kNoElement) hint = hit.element;
        return hit.element != kNoElement;
    }

    /// Whether some shape is no further from `p` than `distance`. Often much quicker than `closest`.
    [[nodiscard]] bool within(const Vec3& p, double distance) const {
        return search(p, distance * distance, distance * distance).element != kNoElement;
    }

private:
    using Matrix3 = Eigen::Matrix3d;

    // Four floats that the compiler keeps in one register where there is one. Both compilers know these.
    using Lanes = float __attribute__((vector_size(16)));
    static constexpr std::size_t kWidth = 4;

    /// Boxes of the children, a lane each, in the index's own frame; child i is the leaf of shapes [child, child + count) where
    /// count > 0, else the node `child`; unused lanes, at the end, have kNoElement.
    struct alignas(16) Node {
        std::array<Lanes, 3> min;
        std::array<Lanes, 3> max;
        std::array<std::uint32_t, kWidth> child;
        std::array<std::uint32_t, kWidth> count;
    };
    class Builder;
    struct Query;

    /// Ends at the first shape whose squared distance is at most `enough`.
    [[nodiscard]] Hit search(const Vec3& p, double upper_squared, double enough) const;
    [[nodiscard]] Eigen::Vector3f in_own_frame(const Vec3& p) const;
    [[nodiscard]] double far_bound(double squared_distance) const;
    void search_leaf(const Vec3& p, std::uint32_t first, std::uint32_t count, Hit& hit) const;

    std::vector<Prepared> shapes_;        ///< in the order of the leaves
    std::vector<std::uint32_t> element_;  ///< of each slot in shapes_
    std::vector<std::uint32_t> slot_;     ///< of each element
    std::vector<Node> nodes_;             ///< the root first; empty without shapes
    Vec3 centre_ = Vec3::Zero();
    Matrix3 turn_ = Matrix3::Identity();  ///< own frame: scaled turn * (p - centre), all shapes within -1..1
    double scale_ = 1;
};

extern template class ShapeIndex<TriangleShape>;
extern template class ShapeIndex<SegmentShape>;

}  // namespace vsplit

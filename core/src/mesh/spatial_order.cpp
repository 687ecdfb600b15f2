#include "mesh/spatial_order.h"

#include <tbb/parallel_sort.h>

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "base/huge_pages.h"

namespace vsplit {
namespace {

constexpr int kBitsPerAxis = 21;

/// Spreads the low 21 bits of x to every third bit.
std::uint64_t spread(std::uint64_t x) {
    x = (x | x << 32U) & 0x001F00000000FFFFULL;
    x = (x | x << 16U) & 0x001F0000FF0000FFULL;
    x = (x | x << 8U) & 0x100F00F00F00F00FULL;
    x = (x | x << 4U) & 0x10C30C30C30C30C3ULL;
    return (x | x << 2U) & 0x1249249249249249ULL;
}

/// Cells of a grid over a box, numbered along the curve.
class MortonGrid {
public:
    explicit MortonGrid(const BoundingBox& box) : min_(box.min) {
        const double extent = (box.max - box.min).maxCoeff();
        scale_ = extent > 0 ? static_cast<double>((1U << kBitsPerAxis) - 1) / extent : 0;
    }
    [[nodiscard]] std::uint64_t cell(const Vec3& p) const {
        const Vec3 at = (p - min_) * scale_;
        return spread(static_cast<std::uint64_t>(at.x())) | spread(static_cast<std::uint64_t>(at.y())) << 1U |
               spread(static_cast<std::uint64_t>(at.z())) << 2U;
    }

private:
    Vec3 min_;
    double scale_ = 0;
};

/// Indices 0..count-1 in order of their cell, ties by index.
template <class Cell>
std::vector<std::uint32_t> sorted_by(std::uint32_t count, Cell cell) {
    auto keys = large_vector<std::pair<std::uint64_t, std::uint32_t>>(count);
    for (std::uint32_t i = 0; i < count; ++i) keys[i] = {cell(i), i};
    tbb::parallel_sort(keys.begin(), keys.end());
    auto order = large_vector<std::uint32_t>(count);
    for (std::uint32_t i = 0; i < count; ++i) order[i] = keys[i].second;
    return order;
}

}  // namespace

void order_spatially(SubdividedMesh& subdivided) {
    TriangleMesh& mesh = subdivided.mesh;
    const MortonGrid grid(bounding_box(mesh));
    const std::vector<std::uint32_t> vertices =
        sorted_by(mesh.vertex_count(), [&](std::uint32_t v) { return grid.cell(mesh.positions[v]); });
    const std::vector<std::uint32_t> faces = sorted_by(mesh.face_count(), [&](std::uint32_t f) {
        const Triangle& t = mesh.faces[f];
        return grid.cell((mesh.positions[t[0]] + mesh.positions[t[1]] + mesh.positions[t[2]]) / 3);
    });

    TriangleMesh ordered;
    auto number = large_vector<std::uint32_t>(vertices.size());
    reserve_large(ordered.positions, vertices.size());
    for (const std::uint32_t v : vertices) {
        number[v] = ordered.vertex_count();
        ordered.positions.push_back(mesh.positions[v]);
    }
    std::vector<std::uint32_t> parent;
    reserve_large(parent, faces.size());
    reserve_large(ordered.faces, faces.size());
    for (const std::uint32_t f : faces) {
        const Triangle& t = mesh.faces[f];
        ordered.faces.push_back({number[t[0]], number[t[1]], number[t[2]]});
        parent.push_back(subdivided.parent[f]);
    }
    mesh = std::move(ordered);
    subdivided.parent = std::move(parent);
}

}  // namespace vsplit

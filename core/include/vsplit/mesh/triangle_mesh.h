#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace vsplit {

using Vec3 = Eigen::Vector3d;

/// Vertex indices of a face, counter-clockwise seen from outside.
using Triangle = std::array<std::uint32_t, 3>;

/// Faces under a name: those of some regions. Sets may overlap.
struct FaceSet {
    std::string name;
    std::vector<std::uint32_t> regions;

    friend bool operator==(const FaceSet&, const FaceSet&) = default;
};

/// An indexed triangle mesh: what is read, written, and handed from verb to verb.
/// Indices are 0-based; a valid mesh has every index below `positions.size()` (see `inspect`).
struct TriangleMesh {
    std::vector<Vec3> positions;
    std::vector<Triangle> faces;
    std::vector<std::uint32_t> regions{};  ///< an id a face, in order; empty: the mesh has no regions
    std::vector<FaceSet> sets{};           ///< names of regions, for who reads and writes files

    [[nodiscard]] std::uint32_t vertex_count() const { return static_cast<std::uint32_t>(positions.size()); }
    [[nodiscard]] std::uint32_t face_count() const { return static_cast<std::uint32_t>(faces.size()); }

    friend bool operator==(const TriangleMesh&, const TriangleMesh&) = default;
};

/// Axis-aligned; empty (min > max) when no point was added.
struct BoundingBox {
    Vec3 min = Vec3::Constant(1e300);
    Vec3 max = Vec3::Constant(-1e300);

    [[nodiscard]] bool empty() const { return min.x() > max.x(); }
    [[nodiscard]] double diagonal() const { return empty() ? 0.0 : (max - min).norm(); }
};

/// O(vertices). Vertices no face uses count too.
[[nodiscard]] BoundingBox bounding_box(const TriangleMesh& mesh);

/// O(faces).
[[nodiscard]] double surface_area(const TriangleMesh& mesh);

/// Volume enclosed by a closed, consistently oriented mesh (positive when faces look outward). O(faces).
[[nodiscard]] double enclosed_volume(const TriangleMesh& mesh);

}  // namespace vsplit

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "quality/face_bounds.h"
#include "simplify/fan_shape.h"
#include "vsplit/mesh/triangle_mesh.h"

namespace vsplit {

/// The faces that a collapse leaves around its vertex k: a closed polygon of ring vertices, counter-clockwise, each face
/// (k, ring t, ring t+1), and what each face's normal was before. On an open boundary the polygon is open: one vertex more than
/// faces, k lies between the last and the first.
class Fan {
public:
    /// Faces that fit.
    static constexpr std::size_t kCapacity = FanColumns::kFaces;

    /// Sets ring vertex t: `v` at `position`, and the face from it to the next one, which looked along `normal` before.
    /// \pre t < kCapacity.
    void put(std::size_t t, std::uint32_t v, const Vec3& position, std::uint32_t face, const Eigen::Vector3f& normal) {
        vertex_[t] = v;
        face_[t] = face;
        columns_.x[t] = position.x();
        columns_.y[t] = position.y();
        columns_.z[t] = position.z();
        columns_.old_nx[t] = normal.x();
        columns_.old_ny[t] = normal.y();
        columns_.old_nz[t] = normal.z();
    }

    /// Closes the ring of the vertices put so far, `faces` of them. O(1).
    void close(std::size_t faces);

    /// Takes `ghost` and its two faces out of the `count` vertices put so far; what is left is open. \pre one of them is the
    /// ghost, and count is at least 3. O(count).
    void open_at(std::uint32_t ghost, std::size_t count);

    using Shape = FanShape;

    /// What the fan would be with k at `position`. O(faces).
    [[nodiscard]] Shape shape_at(const Vec3& position);

    /// What faces [first, last) lack of `bounds` with k at `apex`. O(last - first).
    [[nodiscard]] Excess excess(const FaceBounds& bounds, const Vec3& apex, std::size_t first, std::size_t last) const;
    [[nodiscard]] Excess excess(const FaceBounds& bounds, const Vec3& apex) const { return excess(bounds, apex, 0, size_); }

    /// Faces.
    [[nodiscard]] std::size_t size() const { return size_; }
    [[nodiscard]] bool is_open() const { return ring_size_ != size_; }
    /// Vertices of the ring.
    [[nodiscard]] std::size_t ring_size() const { return ring_size_; }
    [[nodiscard]] std::uint32_t vertex(std::size_t t) const { return vertex_[t]; }
    [[nodiscard]] std::uint32_t face(std::size_t t) const { return face_[t]; }
    /// Of face t, by the last shape_at.
    [[nodiscard]] double stretch(std::size_t t) const { return columns_.stretch[t]; }
    [[nodiscard]] double face_size(std::size_t t) const { return columns_.face_size[t]; }
    /// From the vertex to ring vertex t, by the last shape_at.
    [[nodiscard]] double spoke(std::size_t t) const { return columns_.spoke[t]; }
    /// \pre the face did not fold.
    [[nodiscard]] Eigen::Vector3f normal(std::size_t t) const;
    /// Where ring vertex t stands; t = size() is the first again, or the last of an open ring.
    [[nodiscard]] Vec3 ring(std::size_t t) const { return {columns_.x[t], columns_.y[t], columns_.z[t]}; }
    [[nodiscard]] Vec3 old_normal(std::size_t t) const { return {columns_.old_nx[t], columns_.old_ny[t], columns_.old_nz[t]}; }
    /// Mean of (1 - stretch)^2, by the last shape_at: 0 where all faces are equilateral.
    [[nodiscard]] double defect() const;
    /// Mean of the ring's vertices.
    [[nodiscard]] Vec3 centroid() const;

private:
    std::size_t size_ = 0;
    std::size_t ring_size_ = 0;
    bool is_measured_ = false;  // columns_.ring is there
    Vec3 apex_ = Vec3::Zero();  // of the last shape_at
    std::array<std::uint32_t, kCapacity> vertex_{}, face_{};
    FanColumns columns_;
};

}  // namespace vsplit

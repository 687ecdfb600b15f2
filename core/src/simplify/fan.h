#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "quality/face_bounds.h"
#include "vsplit/mesh/triangle_mesh.h"

namespace vsplit {

/// The faces that a collapse leaves around its vertex k: a closed polygon of ring vertices, counter-clockwise, each face
/// (k, ring t, ring t+1), and what each face's normal was before. On an open boundary the polygon is open: one vertex more than
/// faces, k lies between the last and the first. Structure of arrays, so that a fan is evaluated as vectors.
class Fan {
public:
    /// Faces that fit.
    static constexpr std::size_t kCapacity = 64;

    /// Sets ring vertex t: `v` at `position`, and the face from it to the next one, which looked along `normal` before.
    /// \pre t < kCapacity.
    void put(std::size_t t, std::uint32_t v, const Vec3& position, std::uint32_t face, const Eigen::Vector3f& normal) {
        vertex_[t] = v;
        face_[t] = face;
        x_[t] = position.x();
        y_[t] = position.y();
        z_[t] = position.z();
        old_nx_[t] = normal.x();
        old_ny_[t] = normal.y();
        old_nz_[t] = normal.z();
    }

    /// Closes the ring of the vertices put so far, `faces` of them. O(faces).
    void close(std::size_t faces);

    /// Takes `ghost` and its two faces out of the `count` vertices put so far; what is left is open. \pre one of them is the
    /// ghost, and count is at least 3. O(count).
    void open_at(std::uint32_t ghost, std::size_t count);

    /// What the fan would be with k at a place.
    struct Shape {
        double stretch_min = 0;
        double stretch_sum = 0;
        double size_max = 0;
        bool folds = false;  ///< some face would turn its normal by more than about 78 degrees, or lose its area
    };

    /// Stretch and size of every face for k at `position`. O(faces).
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
    [[nodiscard]] double stretch(std::size_t t) const { return stretch_[t]; }
    [[nodiscard]] double face_size(std::size_t t) const { return face_size_[t]; }
    /// From the vertex to ring vertex t, by the last shape_at.
    [[nodiscard]] double spoke(std::size_t t) const { return spoke_length_[t]; }
    /// \pre the face did not fold.
    [[nodiscard]] Eigen::Vector3f normal(std::size_t t) const;
    /// Where ring vertex t stands; t = size() is the first again, or the last of an open ring.
    [[nodiscard]] Vec3 ring(std::size_t t) const { return {x_[t], y_[t], z_[t]}; }
    [[nodiscard]] Vec3 old_normal(std::size_t t) const { return {old_nx_[t], old_ny_[t], old_nz_[t]}; }
    /// Mean of (1 - stretch)^2, by the last shape_at: 0 where all faces are equilateral.
    [[nodiscard]] double defect() const;
    /// Mean of the ring's vertices.
    [[nodiscard]] Vec3 centroid() const;

private:
    // One more than faces, the first ring vertex again at the end, rounded up to whole blocks of vectors and one beyond.
    using Column = std::array<double, kCapacity + 8>;

    std::size_t size_ = 0;
    std::size_t ring_size_ = 0;
    std::array<std::uint32_t, kCapacity> vertex_{}, face_{};
    Column x_{}, y_{}, z_{}, old_nx_{}, old_ny_{}, old_nz_{};
    Column ring_length_{}, spoke_length_{}, spoke_x_{}, spoke_y_{}, spoke_z_{};
    Column stretch_{}, face_size_{}, folded_{};
};

}  // namespace vsplit

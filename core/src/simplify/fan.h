#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "vsplit/mesh/triangle_mesh.h"

namespace vsplit {

/// The faces that a collapse leaves around its vertex k: a closed polygon of ring vertices, counter-clockwise, each face
/// (k, ring t, ring t+1), and what each face's normal was before. Structure of arrays, so that a fan is evaluated as vectors.
class Fan {
public:
    /// Faces that fit.
    static constexpr std::size_t kCapacity = 64;

    void clear() { size_ = 0; }

    /// Adds ring vertex `v` at `position` and the face from it to the next one, which looked along `normal` before.
    /// \pre size() < kCapacity.
    void add(std::uint32_t v, const Vec3& position, std::uint32_t face, const Eigen::Vector3f& normal) {
        vertex_[size_] = v;
        face_[size_] = face;
        x_[size_] = position.x();
        y_[size_] = position.y();
        z_[size_] = position.z();
        old_nx_[size_] = normal.x();
        old_ny_[size_] = normal.y();
        old_nz_[size_] = normal.z();
        ++size_;
    }

    /// Closes the ring: call once after the last add. O(faces).
    void close();

    /// What the fan would be with k at a place.
    struct Shape {
        double stretch_min = 0;
        double stretch_sum = 0;
        double size_max = 0;
        bool folds = false;  ///< some face would turn its normal by more than about 78 degrees, or lose its area
    };

    /// Stretch and size of every face for k at `position`. O(faces).
    [[nodiscard]] Shape shape_at(const Vec3& position);

    [[nodiscard]] std::size_t size() const { return size_; }
    [[nodiscard]] std::uint32_t vertex(std::size_t t) const { return vertex_[t]; }
    [[nodiscard]] std::uint32_t face(std::size_t t) const { return face_[t]; }
    /// Of face t, by the last shape_at.
    [[nodiscard]] double stretch(std::size_t t) const { return stretch_[t]; }
    [[nodiscard]] double face_size(std::size_t t) const { return face_size_[t]; }
    /// \pre the face did not fold.
    [[nodiscard]] Eigen::Vector3f normal(std::size_t t) const;
    /// Mean of the ring's vertices.
    [[nodiscard]] Vec3 centroid() const;

private:
    // One more than faces: the first ring vertex again at the end. A multiple of the vector length.
    using Column = std::array<double, kCapacity + 4>;

    std::size_t size_ = 0;
    std::array<std::uint32_t, kCapacity> vertex_{}, face_{};
    Column x_{}, y_{}, z_{}, old_nx_{}, old_ny_{}, old_nz_{};
    Column ring_length_{}, spoke_length_{}, spoke_x_{}, spoke_y_{}, spoke_z_{};
    Column stretch_{}, face_size_{}, folded_{};
};

}  // namespace vsplit

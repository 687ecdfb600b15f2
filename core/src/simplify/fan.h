#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "vsplit/mesh/triangle_mesh.h"

namespace vsplit {

/// The faces that a collapse leaves around its vertex k: a closed polygon of ring vertices, counter-clockwise, each face
/// (k, ring t, ring t+1), and what each face's normal was before. Structure of arrays, so that a fan is evaluated as vectors.
/// One object serves many edges and keeps its memory.
class Fan {
public:
    /// Empties the fan and makes room for `faces` faces.
    void reset(std::size_t faces);

    /// Adds ring vertex `v` at `position` and the face from it to the next one.
    void add(std::uint32_t v, const Vec3& position, std::uint32_t face, const Vec3& normal_before) {
        vertex[size_] = v;
        face_number[size_] = face;
        x[size_] = position.x();
        y[size_] = position.y();
        z[size_] = position.z();
        old_nx[size_] = normal_before.x();
        old_ny[size_] = normal_before.y();
        old_nz[size_] = normal_before.z();
        ++size_;
    }

    /// Closes the ring: call once after the last add. O(faces).
    void close();

    /// What the fan would be with k at a place.
    struct Shape {
        double stretch_min = 0;
        double stretch_sum = 0;
        double size_max = 0;
        bool folds = false;   ///< some face would turn its normal by more than about 78 degrees, or lose its area
    };

    /// Computes stretch, size and doubled-area normal of every face for k at `position`. O(faces).
    [[nodiscard]] Shape shape_at(const Vec3& position);

    [[nodiscard]] std::size_t size() const { return size_; }
    /// Mean of the ring's vertices.
    [[nodiscard]] Vec3 centroid() const;

    std::vector<std::uint32_t> vertex, face_number;
    std::vector<double> x, y, z;                        // one more than faces: the first again at the end
    std::vector<double> old_nx, old_ny, old_nz;
    std::vector<double> stretch, size_of, nx, ny, nz;   // by the last shape_at; normals as unit vectors

private:
    std::size_t size_ = 0;
    std::vector<double> ring_length_, spoke_length_, sx_, sy_, sz_, turn_;
};

}  // namespace vsplit

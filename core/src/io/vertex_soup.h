#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mesh/exact_merger.h"
#include "vsplit/mesh/triangle_mesh.h"

namespace vsplit {

/// Collects the triangles of a format that repeats each vertex in every face (STL), and numbers equal vertices once while it
/// does: the six copies of each vertex are never all in memory.
class VertexSoup {
public:
    /// Makes room for so many triangles.
    void reserve_faces(std::size_t faces);

    /// \pre finite coordinates.
    void add_triangle(const Vec3& a, const Vec3& b, const Vec3& c) {
        waiting_[waiting_count_++] = a;
        waiting_[waiting_count_++] = b;
        waiting_[waiting_count_++] = c;
        if (waiting_count_ == waiting_.size()) merge_waiting();
    }

    [[nodiscard]] std::size_t face_count() const { return faces_.size() + waiting_count_ / 3; }

    /// The mesh; each vertex is there once.
    [[nodiscard]] TriangleMesh take();

private:
    static_assert(ExactMerger::kBatch % 3 == 0);

    void merge_waiting();

    ExactMerger merger_;
    std::array<Vec3, ExactMerger::kBatch> waiting_;
    std::size_t waiting_count_ = 0;
    std::vector<Vec3> kept_;  // as many as have been numbered, and room for a batch
    std::vector<Triangle> faces_;
};

}  // namespace vsplit

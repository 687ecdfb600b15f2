#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "simplify/half_edge_mesh.h"

namespace vsplit {

/// A mesh cut into parts that may be changed at the same time, each by one thread: ranges of faces, which are near each other
/// since faces are numbered along a curve through space. How it is cut depends on the mesh alone, not on the number of threads.
///
/// A step within a part looks at faces of that part only: moving an interior vertex, turning an edge between four of them,
/// collapsing an edge between two deep ones with what follows. What is left between the parts is for one thread afterwards.
class MeshParts {
public:
    /// How far inside of its part a vertex lies. A step within a part makes no vertex less deep.
    enum class Depth : std::uint8_t {
        kShared,    ///< has faces of several parts, or is a ghost
        kOwned,     ///< has faces of one part only
        kInterior,  ///< and neighbours that are owned
        kDeep       ///< and neighbours that are interior
    };

    struct Faces {
        std::uint32_t begin = 0, end = 0;
    };

    /// One part only, and nothing known of depths, where the mesh has few faces. With `shifted` the cuts go through the middles
    /// of what are parts else. O(faces).
    MeshParts(const HalfEdgeMesh& mesh, bool shifted);

    [[nodiscard]] std::size_t count() const { return faces_.size(); }
    [[nodiscard]] Faces faces(std::size_t part) const { return faces_[part]; }
    /// Interior ones and deeper, in order.
    [[nodiscard]] std::span<const std::uint32_t> interior(std::size_t part) const {
        return std::span(interior_).subspan(first_interior_[part], first_interior_[part + 1] - first_interior_[part]);
    }
    /// Of the vertices that are there.
    [[nodiscard]] double deep_share() const { return deep_share_; }
    /// Vertices that are interior to no part, in order.
    [[nodiscard]] const std::vector<std::uint32_t>& between() const { return between_; }
    [[nodiscard]] Depth depth(std::uint32_t v) const { return depth_[v]; }
    [[nodiscard]] bool is_interior(std::uint32_t v) const { return depth_[v] >= Depth::kInterior; }
    [[nodiscard]] bool is_deep(std::uint32_t v) const { return depth_[v] == Depth::kDeep; }
    /// Whether the edge of h and the two vertices across it are interior.
    [[nodiscard]] bool may_turn(const HalfEdgeMesh& mesh, HalfEdge h) const {
        const HalfEdge g = mesh.twin(h);
        return is_interior(mesh.origin(h)) && is_interior(mesh.origin(g)) && is_interior(mesh.origin(prev(h))) &&
               is_interior(mesh.origin(prev(g)));
    }

private:
    void cut(const HalfEdgeMesh& mesh, bool shifted);
    void find_owners(const HalfEdgeMesh& mesh);
    void deepen(const HalfEdgeMesh& mesh, Depth from, Depth to);
    void list_vertices(const HalfEdgeMesh& mesh);

    std::vector<Faces> faces_;
    std::vector<Depth> depth_;
    std::vector<std::uint32_t> owner_;  // of owned vertices: the part
    std::vector<std::uint32_t> interior_, between_;
    std::vector<std::size_t> first_interior_;
    double deep_share_ = 0;
};

}  // namespace vsplit

#pragma once

#include <cstddef>
#include <cstdint>

#include "vsplit/io/second_order.h"
#include "vsplit/mesh/triangle_mesh.h"

namespace vsplit {

/// What formats of elements write: a mesh's faces as triangles of three nodes, or of six. Holds references.
class Elements {
public:
    explicit Elements(const TriangleMesh& mesh, const MidsideNodes* middle = nullptr) : mesh_(mesh), middle_(middle) {}

    [[nodiscard]] const TriangleMesh& mesh() const { return mesh_; }
    /// Nodes of an element.
    [[nodiscard]] std::uint32_t order_nodes() const { return middle_ == nullptr ? 3 : 6; }
    [[nodiscard]] std::size_t node_count() const {
        return mesh_.positions.size() + (middle_ == nullptr ? 0 : middle_->positions.size());
    }
    [[nodiscard]] const Vec3& position(std::size_t node) const {
        return node < mesh_.positions.size() ? mesh_.positions[node] : middle_->positions[node - mesh_.positions.size()];
    }
    /// Corners, then the middle of the side behind each: the order of all these formats.
    [[nodiscard]] std::uint32_t node(std::size_t face, std::size_t i) const {
        return i < 3 ? mesh_.faces[face][i] : middle_->of_face[face][i - 3];
    }

private:
    const TriangleMesh& mesh_;
    const MidsideNodes* middle_;
};

}  // namespace vsplit

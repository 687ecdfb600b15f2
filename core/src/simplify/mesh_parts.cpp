#include "simplify/mesh_parts.h"

#include <algorithm>

#include "base/for_each_in_parallel.h"

namespace vsplit {
namespace {

/// Live faces a part: so many that what lies between parts is little, so few that there are parts for many threads.
constexpr std::uint32_t kFacesAPart = 12288;

/// Parts begin at multiples of so many faces: marks of half-edges that share a byte are of one part.
constexpr std::uint32_t kAlignment = 4;

}  // namespace

MeshParts::MeshParts(const HalfEdgeMesh& mesh, bool shifted) {
    cut(mesh, shifted);
    if (count() == 1) return;
    find_owners(mesh);
    deepen(mesh, Depth::kOwned, Depth::kInterior);
    deepen(mesh, Depth::kInterior, Depth::kDeep);
    list_vertices(mesh);
}

/// After each so many live faces.
void MeshParts::cut(const HalfEdgeMesh& mesh, bool shifted) {
    const std::uint32_t all = mesh.half_edge_count() / 3;
    const std::uint32_t parts = std::max(1U, mesh.live_faces() / kFacesAPart);
    const std::uint32_t share = mesh.live_faces() / parts;
    faces_.assign(1, {0, all});
    if (parts == 1) return;
    std::uint32_t live = shifted ? share / 2 : 0;
    for (std::uint32_t face = 0; face < all; ++face) {
        if (live >= share && face % kAlignment == 0) {
            faces_.back().end = face;
            faces_.push_back({face, all});
            live = 0;
        }
        live += mesh.visible(face) ? 1 : 0;
    }
}

void MeshParts::find_owners(const HalfEdgeMesh& mesh) {
    depth_.assign(mesh.vertex_count(), Depth::kShared);
    owner_.assign(mesh.vertex_count(), 0);
    const auto part_of = [this](std::uint32_t face) {
        const auto after = std::upper_bound(faces_.begin(), faces_.end(), face,
                                            [](std::uint32_t f, const Faces& part) { return f < part.begin; });
        return static_cast<std::uint32_t>(after - faces_.begin() - 1);
    };
    for_each_in_parallel(mesh.vertex_count(), [&](std::size_t n) {
        const auto v = static_cast<std::uint32_t>(n);
        if (mesh.outgoing(v) == kNone || mesh.is_ghost(v)) return;
        owner_[v] = part_of(face_of(mesh.outgoing(v)));
        const Faces own = faces_[owner_[v]];
        bool owned = true;
        mesh.for_each_outgoing(v, [&](HalfEdge h) { owned &= face_of(h) >= own.begin && face_of(h) < own.end; });
        if (owned) depth_[v] = Depth::kOwned;
    });
}

/// Raises those that have no neighbour less deep.
void MeshParts::deepen(const HalfEdgeMesh& mesh, Depth from, Depth to) {
    std::vector<std::uint8_t> raised(mesh.vertex_count(), 0);
    for_each_in_parallel(mesh.vertex_count(), [&](std::size_t n) {
        const auto v = static_cast<std::uint32_t>(n);
        if (depth_[v] < from) return;
        bool surrounded = true;
        mesh.for_each_outgoing(v, [&](HalfEdge h) { surrounded &= depth_[mesh.target(h)] >= from; });
        raised[v] = surrounded ? 1 : 0;
    });
    for_each_in_parallel(mesh.vertex_count(), [&](std::size_t v) {
        if (raised[v] != 0) depth_[v] = to;
    });
}

void MeshParts::list_vertices(const HalfEdgeMesh& mesh) {
    first_interior_.assign(count() + 1, 0);
    for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
        if (is_interior(v)) ++first_interior_[owner_[v] + 1];
        if (!is_interior(v) && mesh.outgoing(v) != kNone) between_.push_back(v);
    }
    for (std::size_t part = 0; part < count(); ++part) first_interior_[part + 1] += first_interior_[part];
    const auto deep = static_cast<double>(std::count(depth_.begin(), depth_.end(), Depth::kDeep));
    deep_share_ = deep / static_cast<double>(first_interior_.back() + between_.size());
    interior_.resize(first_interior_.back());
    std::vector<std::size_t> next(first_interior_.begin(), first_interior_.end() - 1);
    for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
        if (is_interior(v)) interior_[next[owner_[v]]++] = v;
    }
}

}  // namespace vsplit

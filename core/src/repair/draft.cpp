#include "repair/draft.h"

#include <algorithm>
#include <numeric>
#include <span>
#include <tuple>

namespace vsplit {
namespace {

/// Cuts the face of `pieces` that has the side from -> to into a fan from the opposite corner, through `through` on that side.
void cut_side(std::vector<Triangle>& pieces, std::uint32_t from, std::uint32_t to, std::span<const SideVertex> through) {
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        for (std::size_t corner = 0; corner < 3; ++corner) {
            if (pieces[i][corner] != from || pieces[i][(corner + 1) % 3] != to) continue;
            const std::uint32_t apex = pieces[i][(corner + 2) % 3];
            std::uint32_t before = from;
            for (const SideVertex& next : through) {
                pieces.push_back({before, next.vertex, apex});
                before = next.vertex;
            }
            pieces[i] = {before, to, apex};
            return;
        }
    }
}

}  // namespace

Draft::Draft(const TriangleMesh& input) : mesh(input), parent(input.faces.size()) { std::iota(parent.begin(), parent.end(), 0U); }

Vec3 Draft::centroid(std::uint32_t face) const {
    const Triangle& t = mesh.faces[face];
    return (at(t[0]) + at(t[1]) + at(t[2])) / 3;
}

void Draft::erase_faces(const std::vector<bool>& marked) {
    std::uint32_t kept = 0;
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
        if (marked[f]) continue;
        mesh.faces[kept] = mesh.faces[f];
        if (!mesh.regions.empty()) mesh.regions[kept] = mesh.regions[f];
        parent[kept++] = parent[f];
    }
    mesh.faces.resize(kept);
    parent.resize(kept);
    if (!mesh.regions.empty()) mesh.regions.resize(kept);
}

void Draft::add_faces(std::span<const Triangle> faces, std::uint32_t beside) {
    mesh.faces.insert(mesh.faces.end(), faces.begin(), faces.end());
    parent.resize(mesh.faces.size(), parent[beside]);
    if (!mesh.regions.empty()) mesh.regions.resize(mesh.faces.size(), mesh.regions[beside]);
}

void Draft::drop_collapsed() {
    std::vector<bool> collapsed(mesh.faces.size(), false);
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
        const Triangle& t = mesh.faces[f];
        collapsed[f] = t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
        if (collapsed[f]) changes.add(Finding::Kind::kDroppedFace, centroid(f), parent[f]);
    }
    erase_faces(collapsed);
}

void insert_on_sides(Draft& draft, std::vector<SideVertex> vertices) {
    std::sort(vertices.begin(), vertices.end(), [](const SideVertex& left, const SideVertex& right) {
        return std::tie(left.side, left.at, left.vertex) < std::tie(right.side, right.at, right.vertex);
    });
    std::vector<Triangle> pieces;
    for (std::size_t begin = 0; begin < vertices.size();) {
        const std::uint32_t face = face_of(vertices[begin].side);
        const Triangle whole = draft.mesh.faces[face];
        pieces.assign(1, whole);
        while (begin < vertices.size() && face_of(vertices[begin].side) == face) {
            const HalfEdge side = vertices[begin].side;
            std::size_t end = begin + 1;
            while (end < vertices.size() && vertices[end].side == side) ++end;
            cut_side(pieces, whole[side % 3], whole[next(side) % 3], std::span(vertices).subspan(begin, end - begin));
            begin = end;
        }
        draft.mesh.faces[face] = pieces[0];
        draft.add_faces(std::span(pieces).subspan(1), face);
    }
}

}  // namespace vsplit

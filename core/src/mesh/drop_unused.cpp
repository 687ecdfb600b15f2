#include "mesh/drop_unused.h"

#include <algorithm>
#include <set>

namespace vsplit {
namespace {

bool is_collapsed(const Triangle& face) { return face[0] == face[1] || face[1] == face[2] || face[2] == face[0]; }

std::uint32_t drop_collapsed_faces(TriangleMesh& mesh) {
    if (!mesh.regions.empty()) {
        std::size_t kept = 0;
        for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
            if (!is_collapsed(mesh.faces[f])) mesh.regions[kept++] = mesh.regions[f];
        }
        mesh.regions.resize(kept);
    }
    return static_cast<std::uint32_t>(std::erase_if(mesh.faces, is_collapsed));
}

}  // namespace

WeldCounts drop_unused(TriangleMesh& mesh) {
    WeldCounts counts;
    counts.collapsed_faces = drop_collapsed_faces(mesh);
    std::vector<std::uint32_t> number(mesh.positions.size(), 0);
    for (const Triangle& face : mesh.faces) {
        for (const std::uint32_t vertex : face) number[vertex] = 1;
    }
    counts.unused_vertices = static_cast<std::uint32_t>(std::count(number.begin(), number.end(), 0U));
    if (counts.unused_vertices == 0) return counts;

    std::uint32_t next = 0;
    for (std::size_t vertex = 0; vertex < number.size(); ++vertex) {
        if (number[vertex] == 0) continue;
        mesh.positions[next] = mesh.positions[vertex];
        number[vertex] = next++;
    }
    mesh.positions.resize(next);
    for (Triangle& face : mesh.faces) {
        for (std::uint32_t& vertex : face) vertex = number[vertex];
    }
    return counts;
}

std::vector<std::string> drop_unused_sets(TriangleMesh& mesh) {
    std::vector<std::string> names;
    if (mesh.sets.empty()) return names;
    const std::set<std::uint32_t> used(mesh.regions.begin(), mesh.regions.end());
    std::erase_if(mesh.sets, [&](const FaceSet& set) {
        const auto has_face = [&](std::uint32_t region) { return used.count(region) != 0; };
        if (std::any_of(set.regions.begin(), set.regions.end(), has_face)) return false;
        names.push_back(set.name);
        return true;
    });
    return names;
}

}  // namespace vsplit

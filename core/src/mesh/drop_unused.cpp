#include "mesh/drop_unused.h"

#include <algorithm>
#include <set>

#include "vsplit/mesh/finding.h"

namespace vsplit {
namespace {

bool is_collapsed(const Triangle& face) { return face[0] == face[1] || face[1] == face[2] || face[2] == face[0]; }

/// Regions of `faces` that none of `mesh` has and no set names.
std::vector<std::uint32_t> regions_gone(const std::vector<std::uint32_t>& regions, const TriangleMesh& mesh) {
    std::set<std::uint32_t> gone(regions.begin(), regions.end());
    gone.erase(0);  // is no group
    for (const std::uint32_t region : mesh.regions) gone.erase(region);
    for (const FaceSet& set : mesh.sets) {
        for (const std::uint32_t region : set.regions) gone.erase(region);
    }
    return {gone.begin(), gone.end()};
}

void drop_collapsed_faces(TriangleMesh& mesh, WeldCounts& counts) {
    std::vector<std::uint32_t> dropped_regions;
    std::size_t kept = 0;
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
        const Triangle face = mesh.faces[f];
        if (!is_collapsed(face)) {
            if (!mesh.regions.empty()) mesh.regions[kept] = mesh.regions[f];
            mesh.faces[kept++] = face;
            continue;
        }
        if (!mesh.regions.empty()) dropped_regions.push_back(mesh.regions[f]);
        if (counts.collapsed_faces++ >= Finding::kExamples) continue;
        counts.collapsed_places.emplace_back((mesh.positions[face[0]] + mesh.positions[face[1]] + mesh.positions[face[2]]) / 3);
    }
    mesh.faces.resize(kept);
    if (dropped_regions.empty()) return;
    mesh.regions.resize(kept);
    counts.emptied_regions = regions_gone(dropped_regions, mesh);
}

}  // namespace

WeldCounts drop_unused(TriangleMesh& mesh) {
    WeldCounts counts;
    drop_collapsed_faces(mesh, counts);
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

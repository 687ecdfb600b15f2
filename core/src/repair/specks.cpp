#include <algorithm>
#include <vector>

#include "mesh/disjoint_sets.h"
#include "repair/pieces.h"
#include "repair/steps.h"

namespace vsplit {

Pieces find_pieces(const TriangleMesh& mesh) {
    DisjointSets sets(mesh.faces.size());
    EdgeIndex(mesh).for_each_edge([&](const EdgeIndex::Entry* first, const EdgeIndex::Entry* last) {
        for (const auto* other = first + 1; other != last; ++other)
            sets.join(face_of(first->half_edge), face_of(other->half_edge));
    });
    Pieces pieces{std::vector<std::uint32_t>(mesh.faces.size()), std::vector<BoundingBox>(mesh.faces.size())};
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
        pieces.of_face[f] = sets.find(f);
        BoundingBox& box = pieces.box[pieces.of_face[f]];
        for (const std::uint32_t v : mesh.faces[f]) {
            box.min = box.min.cwiseMin(mesh.positions[v]);
            box.max = box.max.cwiseMax(mesh.positions[v]);
        }
    }
    return pieces;
}

void drop_specks(Draft& draft, double size) {
    const Pieces pieces = find_pieces(draft.mesh);
    std::vector<bool> dropped(draft.mesh.faces.size());
    double largest = 0;  // is kept whatever its size
    for (std::uint32_t f = 0; f < dropped.size(); ++f) largest = std::max(largest, pieces.box[pieces.of_face[f]].diagonal());
    const double kept_from = std::min(size, largest);
    for (std::uint32_t f = 0; f < dropped.size(); ++f) dropped[f] = pieces.box[pieces.of_face[f]].diagonal() < kept_from;
    for (std::uint32_t f = 0; f < dropped.size(); ++f) {
        if (!dropped[f] || pieces.of_face[f] != f) continue;
        draft.changes.add(Finding::Kind::kDroppedSpeck, draft.centroid(f), draft.parent[f]);
    }
    draft.erase_faces(dropped);
}

}  // namespace vsplit

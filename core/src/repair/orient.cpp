#include <utility>
#include <vector>

#include "repair/steps.h"

namespace vsplit {
namespace {

/// across[h]: the other half-edge of an edge with exactly two, whichever way they run; else kNone.
std::vector<HalfEdge> half_edges_across(const TriangleMesh& mesh) {
    std::vector<HalfEdge> across(mesh.faces.size() * 3, kNone);
    EdgeIndex(mesh).for_each_edge([&](const EdgeIndex::Entry* first, const EdgeIndex::Entry* last) {
        if (last - first != 2) return;
        across[first[0].half_edge] = first[1].half_edge;
        across[first[1].half_edge] = first[0].half_edge;
    });
    return across;
}

void turn(Triangle& face) { std::swap(face[1], face[2]); }

/// Walks the piece of `start` and says which of its faces to turn; `turned` of the faces seen is set.
std::vector<std::uint32_t> survey_piece(const TriangleMesh& mesh, const std::vector<HalfEdge>& across, std::uint32_t start,
                                        std::vector<bool>& seen, std::vector<bool>& turned) {
    std::vector<std::uint32_t> piece{start};
    seen[start] = true;
    for (std::size_t i = 0; i < piece.size(); ++i) {
        for (HalfEdge h = 3 * piece[i]; h < 3 * piece[i] + 3; ++h) {
            if (across[h] == kNone || seen[face_of(across[h])]) continue;
            const std::uint32_t other = face_of(across[h]);
            const bool same_direction = origin(mesh, h) == origin(mesh, across[h]);
            seen[other] = true;
            turned[other] = turned[piece[i]] != same_direction;
            piece.push_back(other);
        }
    }
    return piece;
}

}  // namespace

void orient_faces(Draft& draft) {
    TriangleMesh& mesh = draft.mesh;
    const std::vector<HalfEdge> across = half_edges_across(mesh);
    std::vector<bool> seen(mesh.faces.size(), false);
    std::vector<bool> turned(mesh.faces.size(), false);
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
        if (seen[f]) continue;
        const std::vector<std::uint32_t> piece = survey_piece(mesh, across, f, seen, turned);
        std::size_t count = 0;
        for (const std::uint32_t member : piece) count += turned[member] ? 1 : 0;
        if (2 * count <= piece.size()) continue;
        for (const std::uint32_t member : piece) turned[member] = !turned[member];
    }
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
        if (!turned[f]) continue;
        turn(mesh.faces[f]);
        draft.changes.add(Finding::Kind::kTurnedFace, draft.centroid(f), draft.parent[f]);
    }
}

void face_outward(Draft& draft) {
    TriangleMesh& mesh = draft.mesh;
    for (const HalfEdge twin : half_edge_twins(mesh)) {
        if (twin == kNone) return;
    }
    if (enclosed_volume(mesh) >= 0) return;
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
        turn(mesh.faces[f]);
        draft.changes.add(Finding::Kind::kTurnedFace, draft.centroid(f), draft.parent[f]);
    }
}

}  // namespace vsplit

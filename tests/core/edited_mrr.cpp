#include "tests/core/edited_mrr.h"

#include <algorithm>
#include <set>
#include <stdexcept>

#include "mesh/cap_boundaries.h"

namespace vsplit::test {

RandomEditor::RandomEditor(const TriangleMesh& mesh, std::uint32_t ghosts, std::uint64_t seed)
    : ghosts_(ghosts), random_(seed), mesh_(mesh, ghosts) {}

HalfEdge RandomEditor::any_half_edge() {
    for (;;) {
        const HalfEdge h = random_.below(mesh_.half_edge_count());
        if (!mesh_.removed(h)) return h;
    }
}

bool RandomEditor::joined(std::uint32_t u, std::uint32_t v) const {
    bool found = false;
    mesh_.for_each_outgoing(u, [&](HalfEdge h) { found = found || mesh_.target(h) == v; });
    return found;
}

std::optional<std::uint32_t> RandomEditor::ghost_beside(std::uint32_t v) const {
    std::optional<std::uint32_t> ghost;
    mesh_.for_each_outgoing(v, [&](HalfEdge h) {
        if (is_ghost(mesh_.target(h))) ghost = mesh_.target(h);
    });
    return ghost;
}

bool RandomEditor::may_collapse(const EdgeStar& star) const {
    const std::uint32_t i = mesh_.origin(star.ij), j = mesh_.origin(star.ji);
    if (is_ghost(i) || is_ghost(j)) return false;
    if (mesh_.valence(mesh_.origin(star.ei)) < 4 || mesh_.valence(mesh_.origin(star.bj)) < 4) return false;
    const auto beside_i = ghost_beside(i), beside_j = ghost_beside(j);
    if (beside_i && beside_j && *beside_i != *beside_j) return false;  // would join two boundaries
    std::set<std::uint32_t> ring;
    mesh_.for_each_outgoing(i, [&](HalfEdge h) { ring.insert(mesh_.target(h)); });
    int common = 0;
    mesh_.for_each_outgoing(j, [&](HalfEdge h) { common += ring.count(mesh_.target(h)) > 0 ? 1 : 0; });
    return common == 2;
}

bool RandomEditor::collapse() {
    for (int tries = 0; tries < 300; ++tries) {
        const EdgeStar star = mesh_.star(any_half_edge());
        if (!may_collapse(star)) continue;
        const double share = random_.uniform(0, 1);
        const Vec3 i = mesh_.position(mesh_.origin(star.ij)), j = mesh_.position(mesh_.origin(star.ji));
        const Vec3 position = i + share * (j - i);
        log_.record(mesh_, star, position);
        mesh_.collapse(star, position);
        return true;
    }
    return false;
}

bool RandomEditor::may_flip(HalfEdge h) const {
    const HalfEdge g = mesh_.twin(h);
    for (const HalfEdge corner : {h, prev(h), g, prev(g)}) {
        if (is_ghost(mesh_.origin(corner))) return false;
    }
    return mesh_.valence(mesh_.origin(h)) >= 4 && mesh_.valence(mesh_.origin(g)) >= 4 &&
           !joined(mesh_.origin(prev(h)), mesh_.origin(prev(g)));
}

void RandomEditor::move(std::uint32_t v, const Vec3& to) {
    log_.record_move(mesh_, v);
    mesh_.move(v, to);
}

void RandomEditor::edit(int flips, int moves) {
    for (int n = 0; n < flips; ++n) {
        const HalfEdge h = any_half_edge();
        if (!may_flip(h)) continue;
        mesh_.flip(h);
        log_.record_flip(h);
    }
    for (int n = 0; n < moves; ++n) {
        const std::uint32_t v = mesh_.origin(any_half_edge());
        if (is_ghost(v)) continue;
        const Vec3 before = mesh_.position(v);
        move(v, before + 0.01 * Vec3(random_.uniform(-1, 1), random_.uniform(-1, 1), random_.uniform(-1, 1)));
        if (random_.below(4) == 0) move(v, before);
    }
}

TriangleMesh RandomEditor::complex() const {
    TriangleMesh mesh;
    std::vector<std::uint32_t> number(mesh_.vertex_count(), kNone);
    for (std::uint32_t v = 0; v < mesh_.vertex_count(); ++v) {
        if (mesh_.outgoing(v) == kNone) continue;
        number[v] = mesh.vertex_count();
        mesh.positions.push_back(mesh_.position(v));
    }
    for (HalfEdge h = 0; h < mesh_.half_edge_count(); h += 3) {
        if (mesh_.removed(h)) continue;
        mesh.faces.push_back({number[mesh_.origin(h)], number[mesh_.origin(h + 1)], number[mesh_.origin(h + 2)]});
    }
    return mesh;
}

EditedMrr edited_mrr(const TriangleMesh& mesh, int collapses, std::uint64_t seed, bool keep_complexes) {
    Expected<CappedMesh> capped = cap_boundaries(mesh);
    if (!capped) throw std::invalid_argument(capped.error().message);
    RandomEditor editor(capped->mesh, capped->ghosts, seed);
    EditedMrr edited;
    editor.edit(5, 5);  // before the first collapse: the log must not keep these
    for (int n = 0; n < collapses; ++n) {
        if (keep_complexes) edited.complexes.push_back(editor.complex());
        if (!editor.collapse()) {
            if (keep_complexes) edited.complexes.pop_back();
            break;
        }
        editor.edit(n % 3, n % 4);
    }
    if (keep_complexes) edited.complexes.push_back(editor.complex());
    edited.mrr = editor.build();
    return edited;
}

std::vector<std::array<std::array<double, 3>, 3>> unnumbered(const TriangleMesh& mesh) {
    std::vector<std::array<std::array<double, 3>, 3>> faces;
    for (const Triangle& t : mesh.faces) {
        auto& face = faces.emplace_back();
        for (int c = 0; c < 3; ++c) {
            const Vec3& p = mesh.positions[t[c]];
            face[c] = {p.x(), p.y(), p.z()};
        }
        std::rotate(face.begin(), std::min_element(face.begin(), face.end()), face.end());
    }
    std::sort(faces.begin(), faces.end());
    return faces;
}

}  // namespace vsplit::test

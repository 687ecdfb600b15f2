#include "shapes/segments.h"

#include "features/crease_marks.h"
#include "mesh/disjoint_sets.h"
#include "vsplit/features/sharp_edges.h"

namespace vsplit {
namespace {

constexpr double kRounding = 0.01;  // degrees: what coordinates as floats do to an edge that bends by the angle

bool on_border(const Segments& s, HalfEdge h) { return s.of_face[face_of(h)] != s.of_face[face_of(s.twin[h])]; }

/// The border's half-edge after h: the next around its target that leaves the segment.
HalfEdge following(const Segments& s, HalfEdge h) {
    HalfEdge g = next(h);
    while (!on_border(s, g)) g = next(s.twin[g]);
    return g;
}

void collect_loops(Segments& s) {
    std::vector<bool> seen(s.twin.size(), false);
    for (HalfEdge first = 0; first < s.twin.size(); ++first) {
        if (seen[first] || !on_border(s, first)) continue;
        Segments::Loop loop;
        for (HalfEdge h = first; !seen[h]; h = following(s, h)) {
            seen[h] = true;
            loop.push_back(h);
        }
        s.all[s.of_face[face_of(first)]].loops.push_back(std::move(loop));
    }
}

}  // namespace

std::uint32_t Segments::across(const Loop& loop) const {
    const std::uint32_t other = of_face[vsplit::face_of(twin[loop.front()])];
    for (const HalfEdge h : loop) {
        if (of_face[vsplit::face_of(twin[h])] != other) return kNone;
    }
    return other;
}

Segments find_segments(const TriangleMesh& mesh, const FaceNormals& normals, double angle) {
    CreaseMarks creases(mesh);
    creases.mark(find_sharp_edges(mesh, normals, {angle + kRounding, 1}));
    DisjointSets sets(mesh.faces.size());
    Segments s;
    s.twin.resize(3 * mesh.faces.size());
    for (HalfEdge h = 0; h < s.twin.size(); ++h) {
        s.twin[h] = creases.twin(h);
        if (!creases.marked(h)) sets.join(face_of(h), face_of(s.twin[h]));
    }
    s.of_face.resize(mesh.faces.size());
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
        const std::uint32_t root = sets.find(f);  // the smallest face, so it comes first
        if (root == f) {
            s.of_face[f] = static_cast<std::uint32_t>(s.all.size());
            s.all.emplace_back();
        }
        s.of_face[f] = s.of_face[root];
        s.all[s.of_face[f]].faces.push_back(f);
    }
    collect_loops(s);
    return s;
}

}  // namespace vsplit

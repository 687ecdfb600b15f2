#include <algorithm>
#include <tuple>
#include <vector>

#include "mesh/disjoint_sets.h"
#include "repair/steps.h"

namespace vsplit {
namespace {

struct SortedFace {
    Triangle corners{};
    std::uint32_t face = 0;
    bool odd = false;  ///< looks the other way than its corners in ascending order
};

SortedFace sorted_face(const Triangle& t, std::uint32_t face) {
    SortedFace sorted{t, face, false};
    Triangle& c = sorted.corners;
    for (const auto& [i, j] : {std::pair{0, 1}, {1, 2}, {0, 1}}) {
        if (c[i] <= c[j]) continue;
        std::swap(c[i], c[j]);
        sorted.odd = !sorted.odd;
    }
    return sorted;
}

enum class Fate : unsigned char { kKept, kDropped, kCancelled };

/// What becomes of the faces [first, last) on the same three vertices. Of faces that cancel the first is kCancelled, the others
/// are dropped, and `opposite` of the first is one that looks the other way.
void decide(const SortedFace* first, const SortedFace* last, std::vector<Fate>& fate, std::vector<std::uint32_t>& opposite) {
    const auto odd = std::count_if(first, last, [](const SortedFace& f) { return f.odd; });
    const auto even = (last - first) - odd;
    const auto find = [&](bool is_odd) {
        return std::find_if(first, last, [&](const SortedFace& f) { return f.odd == is_odd; });
    };
    const SortedFace* kept = odd == even ? first : find(odd > even);
    for (const SortedFace* f = first; f != last; ++f) fate[f->face] = Fate::kDropped;
    fate[kept->face] = odd == even ? Fate::kCancelled : Fate::kKept;
    if (odd == even) opposite[kept->face] = find(!first->odd)->face;
}

/// What a piece of cancelled faces has around it: edges where leaving it out leaves a face alone, and edges where it does not.
struct Rim {
    std::uint32_t open = 0;
    std::uint32_t shut = 0;

    /// A sheet, which nothing else touches, or part of a surface that has the other copy too much; else a wall of no thickness.
    [[nodiscard]] bool is_surface() const { return open > shut || shut == 0; }
};

/// Settles the faces that cancel, piece by piece: of a wall no copy is kept, else the one that agrees with the faces beside it.
void settle_cancelled(const TriangleMesh& mesh, std::vector<Fate>& fate, const std::vector<std::uint32_t>& opposite) {
    const EdgeIndex edges(mesh);
    DisjointSets pieces(mesh.faces.size());
    std::vector<Rim> rims(mesh.faces.size());   // by piece
    std::vector<int> votes(mesh.faces.size());  // of edges, for the copy that is marked
    const auto for_each_cancelled_edge = [&](auto visit) {
        edges.for_each_edge([&](const EdgeIndex::Entry* first, const EdgeIndex::Entry* last) {
            const auto is_cancelled = [&](const EdgeIndex::Entry& e) { return fate[face_of(e.half_edge)] == Fate::kCancelled; };
            if (std::any_of(first, last, is_cancelled)) visit(first, last, is_cancelled);
        });
    };
    for_each_cancelled_edge([&](const EdgeIndex::Entry* first, const EdgeIndex::Entry* last, auto is_cancelled) {
        const std::uint32_t any = face_of(std::find_if(first, last, is_cancelled)->half_edge);
        for (const auto* e = first; e != last; ++e) {
            if (is_cancelled(*e)) pieces.join(any, face_of(e->half_edge));
        }
    });
    for_each_cancelled_edge([&](const EdgeIndex::Entry* first, const EdgeIndex::Entry* last, auto is_cancelled) {
        const auto along = [&](const EdgeIndex::Entry& e) { return origin(mesh, e.half_edge) == e.a ? 1 : -1; };
        int kept = 0;
        int balance = 0;
        for (const auto* e = first; e != last; ++e) {
            if (fate[face_of(e->half_edge)] != Fate::kKept) continue;
            ++kept;
            balance += along(*e);
        }
        if (kept == 0) return;
        Rim& rim = rims[pieces.find(face_of(std::find_if(first, last, is_cancelled)->half_edge))];
        ++(kept % 2 != 0 ? rim.open : rim.shut);
        for (const auto* e = first; e != last; ++e) {
            if (is_cancelled(*e)) votes[face_of(e->half_edge)] -= along(*e) * balance;
        }
    });
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
        if (fate[f] != Fate::kCancelled) continue;
        fate[f] = Fate::kDropped;
        if (rims[pieces.find(f)].is_surface()) fate[votes[f] < 0 ? opposite[f] : f] = Fate::kKept;
    }
}

}  // namespace

void drop_duplicates(Draft& draft) {
    const TriangleMesh& mesh = draft.mesh;
    std::vector<SortedFace> sorted;
    sorted.reserve(mesh.faces.size());
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) sorted.push_back(sorted_face(mesh.faces[f], f));
    std::sort(sorted.begin(), sorted.end(), [](const SortedFace& left, const SortedFace& right) {
        return std::tie(left.corners, left.face) < std::tie(right.corners, right.face);
    });
    std::vector<Fate> fate(mesh.faces.size(), Fate::kKept);
    std::vector<std::uint32_t> opposite(mesh.faces.size(), kNone);
    bool any = false;
    for (std::size_t begin = 0; begin < sorted.size();) {
        std::size_t end = begin + 1;
        while (end < sorted.size() && sorted[end].corners == sorted[begin].corners) ++end;
        if (end - begin > 1) decide(&sorted[begin], sorted.data() + end, fate, opposite);
        any = any || end - begin > 1;
        begin = end;
    }
    if (!any) return;
    settle_cancelled(mesh, fate, opposite);
    std::vector<bool> dropped(mesh.faces.size());
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
        dropped[f] = fate[f] == Fate::kDropped;
        if (dropped[f]) draft.changes.add(Finding::Kind::kDroppedDuplicate, draft.centroid(f), draft.parent[f]);
    }
    draft.erase_faces(dropped);
}

}  // namespace vsplit

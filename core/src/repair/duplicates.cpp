#include <algorithm>
#include <span>
#include <tuple>
#include <vector>

#include "mesh/disjoint_sets.h"
#include "repair/region_union.h"
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

/// What becomes of faces on the same three vertices. Of faces that cancel the first is kCancelled, the others
/// are dropped, and `opposite` of the first is one that looks the other way.
void decide(std::span<const SortedFace> copies, std::vector<Fate>& fate, std::vector<std::uint32_t>& opposite) {
    const SortedFace* const first = copies.data();
    const SortedFace* const last = first + copies.size();
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

using Copies = std::span<const SortedFace>;

/// Faces on the same three vertices stand together.
std::vector<SortedFace> sorted_faces(const TriangleMesh& mesh) {
    std::vector<SortedFace> sorted;
    sorted.reserve(mesh.faces.size());
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) sorted.push_back(sorted_face(mesh.faces[f], f));
    std::sort(sorted.begin(), sorted.end(), [](const SortedFace& left, const SortedFace& right) {
        return std::tie(left.corners, left.face) < std::tie(right.corners, right.face);
    });
    return sorted;
}

/// Those that stand together, two or more.
std::vector<Copies> find_copies(const std::vector<SortedFace>& sorted) {
    std::vector<Copies> all;
    for (std::size_t begin = 0, end = 0; begin < sorted.size(); begin = end) {
        for (end = begin + 1; end < sorted.size() && sorted[end].corners == sorted[begin].corners; ++end) {
        }
        if (end - begin > 1) all.push_back(std::span(sorted).subspan(begin, end - begin));
    }
    return all;
}

/// The face that is kept goes into the sets of its copies; what regions lose all the same is told.
void join_regions(Draft& draft, const std::vector<Copies>& all, const std::vector<Fate>& fate) {
    TriangleMesh& mesh = draft.mesh;
    if (mesh.regions.empty()) return;
    RegionUnion regions(mesh);
    const auto lose = [&](std::uint32_t face, std::uint32_t region) {
        if (regions.is_no_group(region)) return;
        draft.changes.add_loss(Finding::Kind::kLostFace, draft.centroid(face), draft.parent[face], regions.label(region));
    };
    for (const Copies& copies : all) {
        const auto kept =
            std::find_if(copies.begin(), copies.end(), [&](const SortedFace& f) { return fate[f.face] == Fate::kKept; });
        for (const SortedFace& f : copies) {
            if (kept == copies.end()) lose(f.face, mesh.regions[f.face]);  // a wall: none is kept
            if (kept == copies.end() || f.face == kept->face) continue;
            const RegionUnion::Joined joined = regions.join(mesh.regions[kept->face], mesh.regions[f.face]);
            mesh.regions[kept->face] = joined.region;
            if (joined.loses) lose(f.face, joined.lost);
        }
    }
}

}  // namespace

void drop_duplicates(Draft& draft) {
    const TriangleMesh& mesh = draft.mesh;
    const std::vector<SortedFace> sorted = sorted_faces(mesh);
    const std::vector<Copies> all = find_copies(sorted);
    if (all.empty()) return;
    std::vector<Fate> fate(mesh.faces.size(), Fate::kKept);
    std::vector<std::uint32_t> opposite(mesh.faces.size(), kNone);
    for (const Copies& copies : all) decide(copies, fate, opposite);
    settle_cancelled(mesh, fate, opposite);
    join_regions(draft, all, fate);
    std::vector<bool> dropped(mesh.faces.size());
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
        dropped[f] = fate[f] == Fate::kDropped;
        if (dropped[f]) draft.changes.add(Finding::Kind::kDroppedDuplicate, draft.centroid(f), draft.parent[f]);
    }
    draft.erase_faces(dropped);
}

}  // namespace vsplit

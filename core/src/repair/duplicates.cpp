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
/// are dropped.
void decide(const SortedFace* first, const SortedFace* last, std::vector<Fate>& fate) {
    const auto odd = std::count_if(first, last, [](const SortedFace& f) { return f.odd; });
    const auto even = (last - first) - odd;
    const auto kept = odd == even ? first : std::find_if(first, last, [&](const SortedFace& f) { return f.odd == (odd > even); });
    for (const SortedFace* f = first; f != last; ++f) fate[f->face] = Fate::kDropped;
    fate[kept->face] = odd == even ? Fate::kCancelled : Fate::kKept;
}

/// Pieces of cancelled faces that touch no kept one are sheets: they are kept.
void keep_sheets(const TriangleMesh& mesh, std::vector<Fate>& fate) {
    const EdgeIndex edges(mesh);
    DisjointSets pieces(mesh.faces.size());
    std::vector<bool> touched(mesh.faces.size(), false);
    const auto for_each_cancelled_edge = [&](auto visit) {
        edges.for_each_edge([&](const EdgeIndex::Entry* first, const EdgeIndex::Entry* last) {
            std::uint32_t cancelled = kNone;
            bool kept = false;
            for (const auto* e = first; e != last; ++e) {
                const std::uint32_t f = face_of(e->half_edge);
                if (fate[f] == Fate::kCancelled && cancelled != kNone) pieces.join(f, cancelled);
                if (fate[f] == Fate::kCancelled) cancelled = f;
                kept = kept || fate[f] == Fate::kKept;
            }
            if (cancelled != kNone) visit(cancelled, kept);
        });
    };
    for_each_cancelled_edge([](std::uint32_t, bool) {});
    for_each_cancelled_edge([&](std::uint32_t face, bool kept) {
        if (kept) touched[pieces.find(face)] = true;
    });
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
        if (fate[f] == Fate::kCancelled) fate[f] = touched[pieces.find(f)] ? Fate::kDropped : Fate::kKept;
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
    bool any = false;
    for (std::size_t begin = 0; begin < sorted.size();) {
        std::size_t end = begin + 1;
        while (end < sorted.size() && sorted[end].corners == sorted[begin].corners) ++end;
        if (end - begin > 1) decide(&sorted[begin], sorted.data() + end, fate);
        any = any || end - begin > 1;
        begin = end;
    }
    if (!any) return;
    keep_sheets(mesh, fate);
    std::vector<bool> dropped(mesh.faces.size());
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
        dropped[f] = fate[f] == Fate::kDropped;
        if (dropped[f]) draft.changes.add(Finding::Kind::kDroppedDuplicate, draft.centroid(f), draft.parent[f]);
    }
    draft.erase_faces(dropped);
}

}  // namespace vsplit

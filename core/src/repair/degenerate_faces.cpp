#include <algorithm>
#include <array>
#include <iterator>
#include <numeric>
#include <vector>

#include "repair/steps.h"
#include "vsplit/quality/stretch.h"

namespace vsplit {
namespace {

constexpr double kDegenerateStretch = 1e-9;  // as `inspect` counts them
constexpr double kNeedle = 1e-6;             // shortest over longest edge: contracting moves nothing that far
constexpr int kRounds = 10;                  // a change may leave a face without area next to it

bool is_degenerate(const Draft& draft, const Triangle& t) {
    return stretch(draft.at(t[0]), draft.at(t[1]), draft.at(t[2])) < kDegenerateStretch;
}

/// Drops those of `needles` that hang; whether there were any.
bool drop_hanging(const TriangleMesh& mesh, const std::vector<std::uint32_t>& needles, std::vector<bool>& dropped) {
    std::vector<std::uint32_t> edge_of(3 * mesh.faces.size());
    std::vector<std::uint32_t> faces_at;  // an edge
    EdgeIndex(mesh).for_each_edge([&](const EdgeIndex::Entry* first, const EdgeIndex::Entry* last) {
        for (const auto* entry = first; entry != last; ++entry)
            edge_of[entry->half_edge] = static_cast<std::uint32_t>(faces_at.size());
        faces_at.push_back(static_cast<std::uint32_t>(last - first));
    });
    bool any = false;
    for (int round = 0; round < kRounds; ++round) {
        bool changed = false;
        for (const std::uint32_t f : needles) {
            if (dropped[f]) continue;
            const std::size_t h = std::size_t{3} * f;
            const std::array<std::uint32_t, 3> edges = {edge_of[h], edge_of[h + 1], edge_of[h + 2]};
            if (std::count_if(edges.begin(), edges.end(), [&](std::uint32_t e) { return faces_at[e] % 2 != 0; }) < 2) continue;
            for (const std::uint32_t e : edges) --faces_at[e];
            dropped[f] = changed = any = true;
        }
        if (!changed) break;
    }
    return any;
}

/// One round over all faces without area. Two changes never share a vertex, so that tables made before hold.
class Round {
public:
    explicit Round(Draft& draft)
        : draft_(draft),
          mesh_(draft.mesh),
          twin_(half_edge_twins(mesh_)),
          touched_(mesh_.positions.size(), false),
          dropped_(mesh_.faces.size(), false) {
        sort_corners();
    }

    /// Whether anything changed.
    bool run() {
        bool changed = false;
        for (std::uint32_t f = 0; f < mesh_.face_count(); ++f) {
            const Triangle t = mesh_.faces[f];
            if (!is_degenerate(draft_, t) || is_touched(t)) continue;
            const Vec3 place = draft_.centroid(f);
            if (!mend(f)) continue;
            changed = true;
            draft_.changes.add(Finding::Kind::kFlattenedFace, place, draft_.parent[f]);
        }
        draft_.erase_faces(dropped_);
        return changed;
    }

private:
    void sort_corners() {
        first_.assign(mesh_.positions.size() + 1, 0);
        for (const Triangle& t : mesh_.faces) {
            for (const std::uint32_t v : t) ++first_[v + 1];
        }
        std::partial_sum(first_.begin(), first_.end(), first_.begin());
        corners_.resize(3 * mesh_.faces.size());
        std::vector<std::uint32_t> slot(first_.begin(), first_.end() - 1);
        for (HalfEdge h = 0; h < corners_.size(); ++h) corners_[slot[origin(mesh_, h)]++] = h;
    }

    [[nodiscard]] bool is_touched(const Triangle& t) const { return touched_[t[0]] || touched_[t[1]] || touched_[t[2]]; }
    [[nodiscard]] double length(HalfEdge h) const {
        return (draft_.at(origin(mesh_, next(h))) - draft_.at(origin(mesh_, h))).norm();
    }

    /// Ascending.
    [[nodiscard]] std::vector<std::uint32_t> neighbours(std::uint32_t vertex) const {
        std::vector<std::uint32_t> ring;
        for (std::uint32_t i = first_[vertex]; i < first_[vertex + 1]; ++i) {
            ring.push_back(origin(mesh_, next(corners_[i])));
            ring.push_back(origin(mesh_, prev(corners_[i])));
        }
        std::sort(ring.begin(), ring.end());
        ring.erase(std::unique(ring.begin(), ring.end()), ring.end());
        return ring;
    }

    [[nodiscard]] bool is_on_border(std::uint32_t vertex) const {
        return std::any_of(corners_.begin() + first_[vertex], corners_.begin() + first_[vertex + 1],
                           [&](HalfEdge h) { return twin_[h] == kNone || twin_[prev(h)] == kNone; });
    }

    bool mend(std::uint32_t f) {
        std::array<HalfEdge, 3> sides{3 * f, 3 * f + 1, 3 * f + 2};
        std::stable_sort(sides.begin(), sides.end(), [&](HalfEdge l, HalfEdge r) { return length(l) < length(r); });
        if (length(sides[0]) <= kNeedle * length(sides[2])) return contract(sides[0]);
        return twin_[sides[2]] == kNone ? drop_at_border(f) : flip(sides[2]);
    }

    bool drop_at_border(std::uint32_t f) {
        dropped_[f] = true;
        touch(mesh_.faces[f]);
        return true;
    }

    void touch(const Triangle& t) {
        for (const std::uint32_t v : t) touched_[v] = true;
    }

    /// h: a -> b in (a, b, c), its twin in (b, a, d), becomes c - d.
    bool flip(HalfEdge h) {
        const HalfEdge g = twin_[h];
        const std::uint32_t a = origin(mesh_, h);
        const std::uint32_t b = origin(mesh_, g);
        const std::uint32_t c = origin(mesh_, prev(h));
        const std::uint32_t d = origin(mesh_, prev(g));
        const std::vector<std::uint32_t> ring = neighbours(c);
        if (c == d || touched_[d] || std::binary_search(ring.begin(), ring.end(), d)) return false;
        mesh_.faces[face_of(h)] = {a, d, c};
        mesh_.faces[face_of(g)] = {d, b, c};
        touch({a, b, c});
        touched_[d] = true;
        return true;
    }

    /// Moves the end of h into its origin where that keeps the mesh a manifold.
    bool contract(HalfEdge h) {
        const std::uint32_t kept = origin(mesh_, h);
        const std::uint32_t gone = origin(mesh_, next(h));
        const std::vector<std::uint32_t> ring = neighbours(gone);
        const std::vector<std::uint32_t> other = neighbours(kept);
        std::vector<std::uint32_t> common;
        std::set_intersection(ring.begin(), ring.end(), other.begin(), other.end(), std::back_inserter(common));
        const bool border = twin_[h] == kNone;
        if (common.size() != (border ? 1 : 2) || ring.size() + other.size() < 7) return false;
        if (!border && is_on_border(kept) && is_on_border(gone)) return false;
        if (std::any_of(ring.begin(), ring.end(), [&](std::uint32_t v) { return touched_[v]; })) return false;
        dropped_[face_of(h)] = true;
        if (!border) dropped_[face_of(twin_[h])] = true;
        for (std::uint32_t i = first_[gone]; i < first_[gone + 1]; ++i) mesh_.faces[corners_[i] / 3][corners_[i] % 3] = kept;
        for (const std::uint32_t v : ring) touched_[v] = true;
        for (const std::uint32_t v : other) touched_[v] = true;
        return true;
    }

    Draft& draft_;
    TriangleMesh& mesh_;
    std::vector<HalfEdge> twin_;
    std::vector<std::uint32_t> first_;  // of each vertex in corners_
    std::vector<HalfEdge> corners_;
    std::vector<bool> touched_;
    std::vector<bool> dropped_;
};

}  // namespace

void drop_hanging_needles(Draft& draft) {
    const TriangleMesh& mesh = draft.mesh;
    std::vector<std::uint32_t> needles;
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
        if (is_degenerate(draft, mesh.faces[f])) needles.push_back(f);
    }
    std::vector<bool> dropped(mesh.faces.size(), false);
    if (needles.empty() || needles.size() == mesh.faces.size() || !drop_hanging(mesh, needles, dropped)) return;
    for (const std::uint32_t f : needles) {
        if (dropped[f]) draft.changes.add(Finding::Kind::kFlattenedFace, draft.centroid(f), draft.parent[f]);
    }
    draft.erase_faces(dropped);
}

void remove_degenerate(Draft& draft) {
    for (int round = 0; round < kRounds && Round(draft).run(); ++round) {
    }
}

}  // namespace vsplit

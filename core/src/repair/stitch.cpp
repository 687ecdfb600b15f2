#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include "repair/segment_grid.h"
#include "repair/steps.h"

namespace vsplit {
namespace {

constexpr double kFirstShare = 1e-5;                 // of the tolerance: where the search begins
constexpr double kGrowth = 3;                        // of the reach from one pass to the next: the closest are joined first
constexpr int kRounds = 20;                          // of a pass; each joins what the one before made neighbours
constexpr double kEnd = 1e-9;                        // share of an edge: closer to its end a vertex lies at the end
constexpr std::uint64_t kMostTests = 1'000'000'000;  // of a vertex against an edge, in all: a few seconds

/// What a pass may join. Vertices much closer than the border's own edges are copies of one, moved by rounding or noise; were
/// they put into edges first, slivers as thin as the noise would keep them apart.
enum class Pass { kCopies, kAll };

constexpr double kCopyShare = 0.2;  // of the shortest border edge at a vertex: a copy of it is no further away

/// The partner of a border vertex: a vertex, or a place on a border edge.
struct Partner {
    double distance = std::numeric_limits<double>::infinity();
    std::uint32_t vertex = kNone;
    HalfEdge side = kNone;
    double at = 0;
};

/// One round of joining at a reach.
class Round {
public:
    Round(Draft& draft, Pass pass, double reach, std::uint64_t& tests)
        : draft_(draft), mesh_(draft.mesh), pass_(pass), reach_(reach), tests_(tests) {
        EdgeIndex(mesh_).for_each_edge([&](const EdgeIndex::Entry* first, const EdgeIndex::Entry* last) {
            if (last - first == 1) border_.push_back(first->half_edge);
        });
        std::sort(border_.begin(), border_.end());
        for (const HalfEdge h : border_) {
            vertices_.push_back(from(h));
            vertices_.push_back(to(h));
        }
        std::sort(vertices_.begin(), vertices_.end());
        vertices_.erase(std::unique(vertices_.begin(), vertices_.end()), vertices_.end());
        sort_faces();
        measure_borders();
    }

    /// Whether anything was joined.
    bool run() {
        std::vector<SegmentGrid::Segment> segments;
        for (const HalfEdge h : border_) segments.push_back({draft_.at(from(h)), draft_.at(to(h))});
        const SegmentGrid grid(segments, reach_);
        std::vector<Partner> near_vertex(vertices_.size());
        std::vector<Partner> near_side(vertices_.size());
        for (std::size_t i = 0; i < vertices_.size(); ++i) search(grid, vertices_[i], near_vertex[i], near_side[i]);
        const bool joined = join_vertices(near_vertex);
        if (!joined && pass_ == Pass::kAll) put_into_sides(near_vertex, near_side);
        return joined || put_;
    }

    [[nodiscard]] bool exhausted() const { return tests_ > kMostTests; }

private:
    [[nodiscard]] std::uint32_t from(HalfEdge h) const { return origin(mesh_, h); }
    [[nodiscard]] std::uint32_t to(HalfEdge h) const { return origin(mesh_, next(h)); }

    void measure_borders() {
        shortest_.assign(mesh_.positions.size(), std::numeric_limits<double>::infinity());
        for (const HalfEdge h : border_) {
            const double length = (draft_.at(to(h)) - draft_.at(from(h))).norm();
            for (const std::uint32_t v : {from(h), to(h)}) shortest_[v] = std::min(shortest_[v], length);
        }
    }

    void sort_faces() {
        first_.assign(mesh_.positions.size() + 1, 0);
        for (const Triangle& t : mesh_.faces) {
            for (const std::uint32_t v : t) ++first_[v + 1];
        }
        std::partial_sum(first_.begin(), first_.end(), first_.begin());
        faces_.resize(3 * mesh_.faces.size());
        std::vector<std::uint32_t> slot(first_.begin(), first_.end() - 1);
        for (std::uint32_t f = 0; f < mesh_.face_count(); ++f) {
            for (const std::uint32_t v : mesh_.faces[f]) faces_[slot[v]++] = f;
        }
    }

    [[nodiscard]] bool have_a_face(std::uint32_t v, std::uint32_t w) const {
        return std::any_of(faces_.begin() + first_[v], faces_.begin() + first_[v + 1], [&](std::uint32_t f) {
            const Triangle& t = mesh_.faces[f];
            return t[0] == w || t[1] == w || t[2] == w;
        });
    }

    void search(const SegmentGrid& grid, std::uint32_t v, Partner& vertex, Partner& side) const {
        const auto candidates = grid.near(draft_.at(v));
        tests_ += candidates.size();
        if (exhausted()) return;
        for (const std::uint32_t number : candidates) {
            const HalfEdge h = border_[number];
            for (const std::uint32_t w : {from(h), to(h)}) consider_vertex(v, w, vertex);
            consider_side(v, h, side);
        }
    }

    void consider_vertex(std::uint32_t v, std::uint32_t w, Partner& best) const {
        const double distance = (draft_.at(v) - draft_.at(w)).norm();
        if (v == w || distance > reach_ || std::pair(distance, w) >= std::pair(best.distance, best.vertex)) return;
        if (pass_ == Pass::kCopies && distance > kCopyShare * std::min(shortest_[v], shortest_[w])) return;
        if (!have_a_face(v, w)) best = {distance, w, kNone, 0};
    }

    void consider_side(std::uint32_t v, HalfEdge h, Partner& best) const {
        const Triangle& t = mesh_.faces[face_of(h)];
        if (t[0] == v || t[1] == v || t[2] == v) return;
        const Vec3 along = draft_.at(to(h)) - draft_.at(from(h));
        const double at = along.dot(draft_.at(v) - draft_.at(from(h))) / along.squaredNorm();
        if (!(at > kEnd && at < 1 - kEnd)) return;
        const double distance = (draft_.at(from(h)) + at * along - draft_.at(v)).norm();
        if (distance <= reach_ && distance < best.distance) best = {distance, kNone, h, at};
    }

    /// Vertices that are each other's nearest become one, the first of the two.
    bool join_vertices(const std::vector<Partner>& near_vertex) {
        std::vector<std::uint32_t> becomes(mesh_.positions.size());
        std::iota(becomes.begin(), becomes.end(), 0U);
        bool joined = false;
        for (std::size_t i = 0; i < vertices_.size(); ++i) {
            const std::uint32_t v = vertices_[i];
            const std::uint32_t w = near_vertex[i].vertex;
            if (w == kNone || w < v || partner_of(w, near_vertex) != v) continue;
            becomes[w] = v;
            joined = true;
            draft_.changes.add(Finding::Kind::kStitchedVertex, draft_.at(w), draft_.parent[faces_[first_[w]]]);
        }
        if (!joined) return false;
        for (Triangle& t : mesh_.faces) {
            for (std::uint32_t& v : t) v = becomes[v];
        }
        return true;
    }

    [[nodiscard]] std::uint32_t partner_of(std::uint32_t w, const std::vector<Partner>& near_vertex) const {
        const auto found = std::lower_bound(vertices_.begin(), vertices_.end(), w);
        return near_vertex[static_cast<std::size_t>(found - vertices_.begin())].vertex;
    }

    void put_into_sides(const std::vector<Partner>& near_vertex, const std::vector<Partner>& near_side) {
        std::vector<SideVertex> vertices;
        for (std::size_t i = 0; i < vertices_.size(); ++i) {
            const Partner& partner = near_side[i];
            if (partner.side == kNone || near_vertex[i].vertex != kNone) continue;
            vertices.push_back({partner.side, partner.at, vertices_[i]});
            draft_.changes.add(Finding::Kind::kStitchedVertex, draft_.at(vertices_[i]),
                               draft_.parent[faces_[first_[vertices_[i]]]]);
        }
        put_ = !vertices.empty();
        insert_on_sides(draft_, std::move(vertices));
    }

    Draft& draft_;
    TriangleMesh& mesh_;
    Pass pass_;
    double reach_;
    std::uint64_t& tests_;
    std::vector<HalfEdge> border_;         // half-edges without another
    std::vector<std::uint32_t> vertices_;  // on them, ascending
    std::vector<std::uint32_t> first_;     // of each vertex in faces_
    std::vector<std::uint32_t> faces_;
    std::vector<double> shortest_;  // border edge at each vertex
    bool put_ = false;
};

}  // namespace

void stitch_borders(Draft& draft, double tolerance, const ExecutionContext& context) {
    std::uint64_t tests = 0;
    const auto going = [&] { return tests <= kMostTests && !context.cancelled(); };
    for (const Pass pass : {Pass::kCopies, Pass::kAll}) {
        for (double reach = kFirstShare * tolerance; going(); reach = std::min(reach * kGrowth, tolerance)) {
            for (int round = 0; round < kRounds && going() && Round(draft, pass, reach, tests).run(); ++round) {
            }
            if (reach >= tolerance) break;
        }
    }
}

}  // namespace vsplit

#include "method/mend_hubs.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "mesh/cap_boundaries.h"
#include "method/editable_mesh.h"
#include "simplify/flip_quad.h"
#include "vsplit/features/face_normals.h"

namespace vsplit {
namespace {

constexpr int kPasses = 4;
/// Beyond so many, plain flips leave too little of the shape, and looking for the best would take the square of the time.
constexpr std::uint32_t kMostForFlips = 24;
/// Of an equilateral face, over its side.
constexpr double kHeight = 0.87;
constexpr int kDepths = 5;

/// Works on a closed mesh whose first vertices may be ghosts. Edges of a boundary stay as they are, and so do those to its ghost.
class HubMender {
public:
    HubMender(const CappedMesh& capped, const std::vector<SharpEdge>& creases, FaceNormals normals, const ControlOptions& options)
        : mesh_(capped.mesh, creases),
          normals_(std::move(normals.normals)),
          ghosts_(capped.ghosts),
          beside_ghost_(capped.mesh.positions.size(), false),
          max_valence_(*options.max_valence),
          min_stretch_(*options.min_stretch),
          tolerance_(*options.tolerance) {
        normals_.resize(capped.mesh.faces.size(), Vec3::Zero());
        for (std::uint32_t ghost = 0; ghost < ghosts_; ++ghost) {
            for (const HalfEdge h : mesh_.spokes(ghost)) beside_ghost_[mesh_.target(h)] = true;
        }
    }

    /// Whether anything was changed.
    bool mend_all(const ExecutionContext& context) {
        bool any = false;
        for (int pass = 0; pass < kPasses; ++pass) {
            bool changed = false;
            for (std::uint32_t v = ghosts_; v < mesh_.mesh().vertex_count() && !context.cancelled(); ++v) changed |= mend(v);
            if (!changed) break;
            any = true;
        }
        return any;
    }

    [[nodiscard]] CreasedMesh result() const {
        return {.mesh = visible_mesh(mesh_.mesh(), ghosts_), .creases = without_ghosts(mesh_.creases(), ghosts_)};
    }

private:
    /// Edges at v that are seen.
    [[nodiscard]] std::uint32_t edges_at(std::uint32_t v) const {
        return mesh_.valence(v) - (v < beside_ghost_.size() && beside_ghost_[v] ? 1 : 0);
    }

    /// Whether a face of the edge is a ghost's: that of a boundary edge, or of one to the ghost.
    [[nodiscard]] bool is_beside_ghost(HalfEdge h) const {
        const HalfEdge g = mesh_.twin(h);
        return std::min({mesh_.origin(h), mesh_.origin(g), mesh_.origin(prev(h)), mesh_.origin(prev(g))}) < ghosts_;
    }

    /// How many more edges v may get; a ghost any number.
    [[nodiscard]] bool has_room_for(std::uint32_t v, std::uint32_t more) const {
        return v < ghosts_ || edges_at(v) + more <= max_valence_;
    }

    bool mend(std::uint32_t hub) {
        bool changed = false;
        while (edges_at(hub) > max_valence_) {
            const bool few = edges_at(hub) <= kMostForFlips;
            if (!(few && flip_best(hub)) && !cut_and_flip(hub)) break;
            changed = true;
        }
        return changed;
    }

    [[nodiscard]] FlipQuad quad(HalfEdge h, const Vec3& c, const Vec3& d) const {
        return {mesh_.position(mesh_.origin(h)), mesh_.position(mesh_.target(h)), c, d, normals_[face_of(h)],
                normals_[face_of(mesh_.twin(h))]};
    }

    [[nodiscard]] bool keeps_surface(const FlipQuad& q) const { return q.normals_stay() && q.moves_surface_within(tolerance_); }

    void flip(HalfEdge h, const FlipQuad& q) {
        mesh_.turn(h);
        normals_[face_of(h)] = q.left.normal;
        normals_[face_of(mesh_.twin(h))] = q.right.normal;
    }

    /// Without a cut, where all neighbours have room and the faces stay in shape.
    bool flip_best(std::uint32_t hub) {
        std::pair<double, HalfEdge> best{min_stretch_, kNone};
        for (const HalfEdge h : mesh_.spokes(hub)) {
            const std::uint32_t c = mesh_.origin(prev(h)), d = mesh_.origin(prev(mesh_.twin(h)));
            if (mesh_.is_crease(h) || is_beside_ghost(h) || mesh_.valence(mesh_.target(h)) <= 3) continue;
            if (!has_room_for(c, 1) || !has_room_for(d, 1)) continue;
            const FlipQuad q = quad(h, mesh_.position(c), mesh_.position(d));
            if (q.least_stretch() > best.first && keeps_surface(q) && !mesh_.has_edge(c, d)) best = {q.least_stretch(), h};
        }
        const HalfEdge h = best.second;
        if (h == kNone) return false;
        flip(h, quad(h, mesh_.position(mesh_.origin(prev(h))), mesh_.position(mesh_.origin(prev(mesh_.twin(h))))));
        return true;
    }

    /// A spoke of the round at hand.
    struct Spoke {
        HalfEdge h = kNone;
        double way = 0;  // from the rim to where it is to be cut, as a share of its length
        bool was_cut = false;
    };

    /// As far from the rim as its edges are long, but no further than half way.
    [[nodiscard]] double way_of_cut(HalfEdge h) const {
        const Vec3& hub = mesh_.position(mesh_.origin(h));
        const Vec3& rim = mesh_.position(mesh_.target(h));
        const double left = (rim - mesh_.position(mesh_.origin(prev(h)))).norm();
        const double right = (rim - mesh_.position(mesh_.origin(prev(mesh_.twin(h))))).norm();
        const double length = (hub - rim).norm();
        return length > 0 ? std::min(0.5, kHeight * (left + right) / 2 / length) : 0.5;
    }

    /// Where a spoke ends once it is cut; each `depth` is half the way left nearer to the hub.
    [[nodiscard]] Vec3 end_of(const Spoke& spoke, int depth) const {
        const Vec3& hub = mesh_.position(mesh_.origin(spoke.h));
        const Vec3& rim = mesh_.position(mesh_.target(spoke.h));
        return spoke.was_cut ? rim : Vec3(hub + std::ldexp(1 - spoke.way, -depth) * (rim - hub));
    }

    /// One round: cuts and flips every other spoke, or as many as need be, cut as far from the hub as the surface stays: around
    /// the tip of a cone flips far from it leave the tolerance. False where none may be.
    bool cut_and_flip(std::uint32_t hub) {
        std::vector<Spoke> spokes;
        for (const HalfEdge h : mesh_.spokes(hub)) spokes.push_back({h, way_of_cut(h)});
        const std::size_t n = spokes.size();
        const std::size_t stride = std::max<std::size_t>(2, n / (n - max_valence_));
        for (int depth = 0; depth < kDepths; ++depth) {
            bool changed = false;
            for (std::size_t t = 0; t + 1 < n && edges_at(hub) > max_valence_;) {
                const bool gone = remove(spokes[(t + n - 1) % n], spokes[t], spokes[t + 1], depth);
                changed |= gone;
                t += gone ? stride : 1;
            }
            if (changed) return true;
        }
        return false;
    }

    /// Flips `spoke`, between two others that are cut first. Nothing is done where it may not be.
    bool remove(Spoke& before, Spoke& spoke, Spoke& after, int depth) {
        if (spoke.was_cut || mesh_.is_crease(spoke.h) || is_beside_ghost(spoke.h)) return false;
        if (!may_end_a_flip(before) || !may_end_a_flip(after) || !has_room(before, spoke, after)) return false;
        const FlipQuad q = quad(spoke.h, end_of(after, depth), end_of(before, depth));
        const double floor = std::min(min_stretch_, q.least_stretch_before());
        if (!keeps_surface(q) || q.least_stretch() < floor) return false;
        if (before.was_cut && after.was_cut && mesh_.has_edge(mesh_.target(before.h), mesh_.target(after.h))) return false;
        cut(before, q.pd);
        cut(after, q.pc);
        flip(spoke.h, q);
        before.h = prev(spoke.h);  // a turn gives the sides of its faces other numbers
        return true;
    }

    /// Whether it is cut, or may be.
    [[nodiscard]] bool may_end_a_flip(const Spoke& spoke) const { return spoke.was_cut || !is_beside_ghost(spoke.h); }

    /// Whether no neighbour gets more edges than it may, or more than it has where it has too many already.
    [[nodiscard]] bool has_room(const Spoke& before, const Spoke& spoke, const Spoke& after) const {
        const std::uint32_t cuts = std::uint32_t{!before.was_cut} + std::uint32_t{!after.was_cut};
        const std::uint32_t rim = mesh_.target(spoke.h);
        if (mesh_.valence(rim) + cuts < 5 || !has_room_for(rim, cuts - std::min(cuts, 1U))) return false;
        // A flip adds an edge to either neighbour, a cut one to the vertices across the spoke.
        if (before.was_cut ? !has_room_for(mesh_.target(before.h), 1)
                           : !has_room_for(mesh_.origin(prev(mesh_.twin(before.h))), 1))
            return false;
        return after.was_cut ? has_room_for(mesh_.target(after.h), 1) : has_room_for(mesh_.origin(prev(after.h)), 1);
    }

    void cut(Spoke& spoke, const Vec3& place) {
        if (spoke.was_cut) return;
        const std::uint32_t left = face_of(spoke.h), right = face_of(mesh_.twin(spoke.h));
        mesh_.split(spoke.h, place);
        normals_.push_back(normals_[left]);
        normals_.push_back(normals_[right]);
        spoke.was_cut = true;
    }

    EditableMesh mesh_;
    std::vector<Vec3> normals_;  // of the faces; anything for those at ghosts
    const std::uint32_t ghosts_;
    std::vector<bool> beside_ghost_;  // of the vertices there were: no boundary edge is cut
    const std::uint32_t max_valence_;
    const double min_stretch_;
    const double tolerance_;
};

bool has_hubs(const TriangleMesh& mesh, std::uint32_t max_valence) {
    const std::vector<std::uint32_t> valence = valences(mesh);
    return std::any_of(valence.begin(), valence.end(), [&](std::uint32_t n) { return n > max_valence; });
}

}  // namespace

std::shared_ptr<const CreasedMesh> mend_hubs(const TriangleMesh& mesh, const ControlOptions& options,
                                             const ExecutionContext& context) {
    if (!options.max_valence || !has_hubs(mesh, *options.max_valence)) return nullptr;
    const FaceNormals normals = face_normals(mesh);
    const CappedMesh capped = cap_manifold(mesh);
    const std::vector<SharpEdge> creases = find_creases(mesh, normals, feature_options(options));
    HubMender mender(capped, with_ghosts(creases, capped.ghosts), normals, options);
    return mender.mend_all(context) ? std::make_shared<const CreasedMesh>(mender.result()) : nullptr;
}

}  // namespace vsplit

#include "simplify/edge_flipper.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <utility>

#include "simplify/flip_quad.h"

namespace vsplit {
namespace {

/// Faces of a better shape are left alone.
constexpr double kGoodEnough = 0.95;

}  // namespace

/// The faces (a, b, c) of h and (b, a, d) of its twin, which would become (d, c, a) and (c, d, b).
struct EdgeFlipper::Quad : FlipQuad {
    FaceState of_h, of_twin;
    std::uint32_t a, b, c, d;

    Quad(const HalfEdgeMesh& mesh, const LocalState& state, HalfEdge h)
        : FlipQuad(mesh.position(mesh.origin(h)), mesh.position(mesh.target(h)), mesh.position(mesh.origin(prev(h))),
                   mesh.position(mesh.origin(prev(mesh.twin(h)))), state.faces[face_of(h)].normal.cast<double>(),
                   state.faces[face_of(mesh.twin(h))].normal.cast<double>()),
          of_h(state.faces[face_of(h)]),
          of_twin(state.faces[face_of(mesh.twin(h))]),
          a(mesh.origin(h)),
          b(mesh.target(h)),
          c(mesh.origin(prev(h))),
          d(mesh.origin(prev(mesh.twin(h)))) {}

    [[nodiscard]] double gain() const { return least_stretch() - std::min(of_h.stretch, of_twin.stretch); }

    [[nodiscard]] static FaceState state(const Face& face, double relative_size) {
        return {face.normal.cast<float>(), face.stretch, relative_size};
    }
};

/// Those that are seen: without one to a ghost.
std::uint32_t EdgeFlipper::edges_at(std::uint32_t v) const {
    return mesh_.valence(v) - (state_.border.ghost_beside(v) == kNone ? 0 : 1);
}

bool EdgeFlipper::has_edge(std::uint32_t from, std::uint32_t to) const {
    bool found = false;
    mesh_.for_each_outgoing(from, [&](HalfEdge h) { found |= mesh_.target(h) == to; });
    return found;
}

/// All but what the flip is wanted for.
bool EdgeFlipper::may_flip(const Quad& quad) const {
    if (mesh_.valence(quad.a) <= 3 || mesh_.valence(quad.b) <= 3) return false;
    if (std::max(edges_at(quad.c), edges_at(quad.d)) >= limits_.max_valence) return false;
    const double length = (quad.pd - quad.pc).norm();
    if (length > limits_.max_size || !state_.sizes.admits(length, quad.c, quad.d)) return false;
    return quad.normals_stay() && quad.moves_surface_within(limits_.tolerance) && !has_edge(quad.c, quad.d);
}

/// A flip that gains stretch breaks no bound on that.
bool EdgeFlipper::keeps_bounds(const Quad& quad) const {
    if (!limits_.bounds.shaped()) return true;
    return quad.excess_after(limits_.bounds).may_follow(quad.excess_before(limits_.bounds));
}

bool EdgeFlipper::guard_admits(const Quad& quad, HalfEdge h) {
    if (guard_ == nullptr) return true;
    const std::uint32_t left = face_of(h), right = face_of(mesh_.twin(h));
    // The side (c, a) of the new left face was of the face of h, the side (d, b) of the right one of its twin's.
    const std::array<DeviationGuard::NewFace, 2> faces{{{left, quad.pd, quad.pc, quad.pa, quad.of_h.normal.cast<double>()},
                                                        {right, quad.pc, quad.pd, quad.pb, quad.of_twin.normal.cast<double>()}}};
    return guard_->replace(std::array{left, right}, faces);
}

bool EdgeFlipper::is_beside_ghost(HalfEdge h) const {
    if (state_.border.empty()) return false;
    const HalfEdge g = mesh_.twin(h);
    const std::uint32_t least = std::min({mesh_.origin(h), mesh_.origin(g), mesh_.origin(prev(h)), mesh_.origin(prev(g))});
    return state_.border.is_ghost(least);
}

bool EdgeFlipper::guards_admit(const Quad& quad, HalfEdge h) {
    return creases_.try_flip(h, quad.left.normal, quad.right.normal) && guard_admits(quad, h);
}

void EdgeFlipper::flip(const Quad& quad, HalfEdge h) {
    log_.record_flip(h);
    mesh_.unmark_crease(h);
    mesh_.flip(h);
    creases_.commit();
    state_.faces[face_of(h)] = Quad::state(quad.left, state_.sizes.relative(quad.left.size, quad.d, quad.c, quad.a));
    state_.faces[face_of(mesh_.twin(h))] =
        Quad::state(quad.right, state_.sizes.relative(quad.right.size, quad.c, quad.d, quad.b));
}

/// Of one of the faces that a flip would make: most flips need not be looked at further.
double EdgeFlipper::left_stretch(HalfEdge h) const {
    const auto at = [this](HalfEdge corner) -> const Vec3& { return mesh_.position(mesh_.origin(corner)); };
    return FlipQuad::Face(at(prev(mesh_.twin(h))), at(prev(h)), at(h)).stretch;
}

bool EdgeFlipper::flip_if_better(HalfEdge h) {
    if (mesh_.is_crease(h) || is_beside_ghost(h)) return false;
    const double stretch = std::min(state_.faces[face_of(h)].stretch, state_.faces[face_of(mesh_.twin(h))].stretch);
    if (stretch > kGoodEnough || !(left_stretch(h) - stretch > kLeastGain)) return false;
    const Quad quad(mesh_, state_, h);
    if (!(quad.gain() > kLeastGain) || !may_flip(quad) || !keeps_bounds(quad) || !guards_admit(quad, h)) return false;
    flip(quad, h);
    return true;
}

/// Whether the edge is a crease that is one still. One that was flattened on the way to less than half of the angle from which on
/// an edge is a crease holds nothing but the faces beside it.
bool EdgeFlipper::bends(HalfEdge h) const {
    if (!mesh_.is_crease(h)) return false;
    const double cosine = state_.faces[face_of(h)].normal.dot(state_.faces[face_of(mesh_.twin(h))].normal);
    return mesh_.is_kept_flat(h) || cosine < std::sqrt((1 + limits_.crease_cosine) / 2);
}

template <class Value>
bool EdgeFlipper::flip_best(Value value_of) {
    std::vector<std::pair<double, HalfEdge>> candidates;
    for (const HalfEdge h : open_) {
        if (bends(h) || is_beside_ghost(h)) continue;
        const Quad quad(mesh_, state_, h);
        const double value = value_of(quad);
        if (value > 0 && may_flip(quad)) candidates.emplace_back(-value, h);
    }
    std::sort(candidates.begin(), candidates.end());
    for (const auto& [value, h] : candidates) {
        const Quad quad(mesh_, state_, h);
        if (!guards_admit(quad, h)) continue;
        flip(quad, h);
        return true;
    }
    return false;
}

bool EdgeFlipper::relieve(std::uint32_t v) {
    const auto stretch_left = [this](const Quad& quad) {
        const Excess after = quad.excess_after(limits_.bounds);
        const Excess before = quad.excess_before(limits_.bounds);
        const bool admitted = after.none() || (after.worst <= before.worst && (after.kinds | before.kinds) == before.kinds);
        return admitted ? quad.least_stretch() : 0.0;
    };
    bool flipped = false;
    while (edges_at(v) > limits_.max_valence) {
        open_.clear();
        mesh_.for_each_outgoing(v, [this](HalfEdge h) { open_.push_back(h); });
        if (!flip_best(stretch_left)) break;
        flipped = true;
    }
    open_.clear();
    return flipped;
}

bool EdgeFlipper::mend(std::uint32_t face) {
    open_ = {3 * face, 3 * face + 1, 3 * face + 2};
    const bool flipped = flip_best([this](const Quad& quad) {
        const Excess before = quad.excess_before(limits_.bounds), after = quad.excess_after(limits_.bounds);
        if (!after.lessens(before)) return 0.0;
        return after.none() ? before.sum : before.sum - after.sum - kLeastGain;  // the last step may be as small as it likes
    });
    open_.clear();
    return flipped;
}

void EdgeFlipper::flip_open_edges() {
    while (!open_.empty()) {
        const HalfEdge h = open_.back();
        open_.pop_back();
        if ((within_ != nullptr && !within_->may_turn(mesh_, h)) || !flip_if_better(h)) continue;
        const HalfEdge g = mesh_.twin(h);
        for (const HalfEdge side : {next(h), prev(h), next(g), prev(g)}) open_.push_back(side);
        changed_.push_back(face_of(h));
        changed_.push_back(face_of(g));
    }
}

/// Whether nothing that flip_if_better looks at has changed since all edges were looked at: faces at the four vertices of the
/// quad, which those across its sides are among.
bool EdgeFlipper::is_as_refused(HalfEdge h) const {
    if (!looked_at_all_) return false;
    const HalfEdge g = mesh_.twin(h);
    const auto last = [this](HalfEdge corner) { return mesh_.changed_at(mesh_.origin(corner)); };
    return std::max({last(h), last(g), last(prev(h)), last(prev(g))}) <= *looked_at_all_;
}

/// Last first.
void EdgeFlipper::flip_noted_edges() {
    for (; !edges_.empty(); edges_.pop_back()) {
        if (is_as_refused(edges_.back())) continue;
        open_ = {edges_.back()};
        flip_open_edges();
    }
    changed_.clear();
}

template <class Take>
void EdgeFlipper::note_edges(MeshParts::Faces faces, Take take) {
    for (HalfEdge h = 3 * faces.end; h-- > 3 * faces.begin;) {
        if (!mesh_.removed(h) && mesh_.edge_of(h) == h && take(h)) edges_.push_back(h);
    }
}

void EdgeFlipper::flip_all() {
    const std::uint32_t start = mesh_.clock();
    note_edges({0, mesh_.half_edge_count() / 3}, [](HalfEdge) { return true; });
    flip_noted_edges();
    looked_at_all_ = start;
}

void EdgeFlipper::flip_within(MeshParts::Faces part, std::optional<std::uint32_t> since) {
    looked_at_all_ = since;
    note_edges(part, [this](HalfEdge h) { return within_->may_turn(mesh_, h); });
    flip_noted_edges();
}

/// What may not turn within a part has a vertex between them in its quad.
void EdgeFlipper::flip_between(const MeshParts& parts, std::uint32_t start) {
    for (const std::uint32_t v : parts.between()) {
        mesh_.for_each_outgoing(v, [this](HalfEdge h) {
            for (const HalfEdge side : {h, next(h)}) edges_.push_back(mesh_.edge_of(side));
        });
    }
    std::sort(edges_.begin(), edges_.end(), std::greater<>());
    edges_.erase(std::unique(edges_.begin(), edges_.end()), edges_.end());
    flip_noted_edges();
    looked_at_all_ = start;
}

void EdgeFlipper::flip_around(std::uint32_t v) {
    changed_.clear();
    open_.clear();
    mesh_.for_each_outgoing(v, [this](HalfEdge h) {
        open_.push_back(next(h));
        open_.push_back(h);
    });
    flip_open_edges();
}

}  // namespace vsplit

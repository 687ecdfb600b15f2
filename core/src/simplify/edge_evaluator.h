#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "mesh/coordinate.h"
#include "simplify/fan.h"
#include "simplify/half_edge_mesh.h"
#include "simplify/local_state.h"
#include "simplify/placement.h"
#include "simplify/policies.h"

namespace vsplit {

/// No collapse makes a vertex of more edges: around one, faces get a stretch under 0.17 on average, below what any solver takes.
/// It also keeps an evaluation from costing more than this many faces on fans of thousands of slivers.
inline constexpr std::uint32_t kValenceCeiling = Fan::kCapacity;

/// What the collapse of an edge would be.
struct Evaluation {
    enum class Verdict {
        kValid,
        kInvalid,     ///< until the neighbourhood changes
        kOutOfReach,  ///< no place is within tolerance: until one of the two ends changes
    };
    Verdict verdict = Verdict::kInvalid;
    double priority = 0;
    Vec3 position = Vec3::Zero();
};

/// Evaluates edges for one thread: owns the scratch memory, reads everything else.
template <class Policy>
class EdgeEvaluator {
public:
    EdgeEvaluator(const HalfEdgeMesh& mesh, const LocalState& state, const Policy& policy, const SimplifyInput& input)
        : mesh_(mesh),
          state_(state),
          policy_(policy),
          centre_(input.centre),
          tolerance_square_(input.tolerance * input.tolerance) {}

    /// What collapsing h's edge would give. O(valence^2). Afterwards fan() is the fan of the collapse, shaped for the position
    /// returned, when valid.
    [[nodiscard]] Evaluation evaluate(HalfEdge h) {
        const Evaluation ranked = rank(h);
        return ranked.verdict == Evaluation::Verdict::kValid && mesh_.pinches(h) ? Evaluation{} : ranked;
    }

    /// The same of a collapse that leaves fewer slivers around than there are; `at` that place, where creases and boundaries
    /// leave a choice.
    [[nodiscard]] Evaluation evaluate_mend(HalfEdge h, const std::optional<Vec3>& at) {
        place_to_mend_ = at;
        mends_ = true;
        Evaluation found = evaluate(h);
        mends_ = false;
        place_to_mend_.reset();
        return found;
    }

    /// The same but that an edge may be called valid whose collapse would pinch the surface. Such edges are few, and which they
    /// are is told soon enough when one is the next to go. O(valence).
    [[nodiscard]] Evaluation rank(HalfEdge h) {
        const std::uint32_t i = mesh_.origin(h);
        const std::uint32_t j = mesh_.target(h);
        if (!state_.border.may_join(i, j)) return {};
        ghost_ = std::min(state_.border.ghost_beside(i), state_.border.ghost_beside(j));  // the same where there are two
        const std::uint32_t valence = mesh_.valence(i) + mesh_.valence(j) - 4;
        if (valence < 3 || valence > kValenceCeiling || !policy_.admits_valence(valence - (ghost_ == kNone ? 0 : 1))) return {};
        gather(h, valence);
        if (!policy_.eligible(before_)) return {};
        ends_ = {i, j};
        Quadric quadric = state_.quadrics[i];
        quadric += state_.quadrics[j];
        error_limit_ = policy_.error_limit(quadric, tolerance_square_);
        if constexpr (Policy::kExtended) {
            if (!keeps_creases(h)) return {};
            evenness_ = evenness(h, valence);
        }
        if (ghost_ != kNone) return evaluate_at_boundary(i, j, quadric);
        if constexpr (Policy::kExtended) {
            // Where several creases meet stays where it is.
            if (is_corner(creases_[0])) return attempt(quadric, mesh_.position(i) - centre_) ? valid_ : Evaluation{};
            if (is_corner(creases_[1])) return attempt(quadric, mesh_.position(j) - centre_) ? valid_ : Evaluation{};
        }
        if (place_to_mend_) return attempt(quadric, *place_to_mend_ - centre_, *place_to_mend_) ? valid_ : Evaluation{};
        const Vec3 centroid = ring_sum_ / static_cast<double>(fan_.ring_size()) - centre_;
        if (attempt(quadric, centroid)) return valid_;
        if (attempt(quadric, project_to_minimum(quadric, centroid))) return valid_;
        const Vec3 middle = (mesh_.position(i) + mesh_.position(j)) * 0.5 - centre_;
        if (attempt(quadric, project_to_minimum(quadric, middle))) return valid_;
        if (attempt(quadric, mesh_.position(i) - centre_)) return valid_;
        if (attempt(quadric, mesh_.position(j) - centre_)) return valid_;
        const std::optional<Vec3> best = minimum(quadric);
        if (!best) return {};
        if (attempt(quadric, *best)) return valid_;
        // At a well-conditioned minimum the error is least: where even that is too much, every place is.
        return {quadric.error(*best) > error_limit_ ? Evaluation::Verdict::kOutOfReach : Evaluation::Verdict::kInvalid};
    }

    [[nodiscard]] const Fan& fan() const { return fan_; }

private:
    /// The candidates of an edge with an end on a boundary, or both, when it lies along it.
    [[nodiscard]] Evaluation evaluate_at_boundary(std::uint32_t i, std::uint32_t j, const Quadric& quadric) {
        const Hold at_i = state_.border.hold(i), at_j = state_.border.hold(j);
        const auto stay_at = [&](std::uint32_t v) { return attempt(quadric, mesh_.position(v) - centre_, mesh_.position(v)); };
        if (at_i != at_j) return stay_at(at_i > at_j ? i : j) ? valid_ : Evaluation{};
        if (at_i != Hold::kAlong) {
            if (!within_tolerance(i, j)) return {};
        } else if (Policy::kExtended && (is_corner(creases_[0]) || is_corner(creases_[1]))) {
            return stay_at(is_corner(creases_[0]) ? i : j) ? valid_ : Evaluation{};
        } else {
            const Vec3 between = (fan_.ring(0) + fan_.ring(fan_.size())) / 2 - centre_;
            if (attempt(quadric, project_to_minimum(quadric, between))) return valid_;
            const Vec3 middle = (mesh_.position(i) + mesh_.position(j)) * 0.5 - centre_;
            if (attempt(quadric, project_to_minimum(quadric, middle))) return valid_;
        }
        return stay_at(i) || stay_at(j) ? valid_ : Evaluation{};
    }

    /// Whether k may stand at `place`, relative to the centre; valid_ is then the evaluation.
    [[nodiscard]] bool attempt(const Quadric& quadric, const Vec3& place) { return attempt(quadric, place, place + centre_); }

    /// The same for a position whose bits are to stay; `place` is it, less the centre.
    [[nodiscard]] bool attempt(const Quadric& quadric, const Vec3& place, const Vec3& position) {
        if (!(quadric.error(place) <= error_limit_)) return false;
        if (!is_valid_position(position)) return false;  // rounding may step over the limit of coordinates
        const Fan::Shape shape = fan_.shape_at(position);
        if (shape.folds || !policy_.admits(before_, shape)) return false;
        if (state_.sizes.binding() && !sizes_admit(position)) return false;
        if (policy_.shaped() && !policy_.admits_excess(before_, fan_.excess(policy_, position))) return false;
        if (mends_ && slivers_after() >= slivers_before_) return false;
        valid_ = {Evaluation::Verdict::kValid, evenness_ * policy_.factor(before_) * shape_quality(shape, fan_.size()), position};
        return true;
    }

    [[nodiscard]] std::size_t slivers_after() const {
        std::size_t count = 0;
        for (std::size_t t = 0; t < fan_.size(); ++t) count += fan_.stretch(t) < kStretchFloor ? 1 : 0;
        return count;
    }

    /// Whether no spoke would be longer than its ends allow.
    [[nodiscard]] bool sizes_admit(const Vec3& position) const {
        const double allowed = state_.sizes.between(mesh_, ends_[0], ends_[1], position);
        for (std::size_t t = 0; t < fan_.ring_size(); ++t) {
            if (!VertexSizes::fits(fan_.spoke(t), allowed, state_.sizes.allowed(fan_.vertex(t)))) return false;
        }
        return true;
    }

    /// Walks the ring of the edge, of `all` vertices, into the fan and sums up the faces before.
    void gather(HalfEdge h, std::uint32_t all) {
        const HalfEdge g = mesh_.twin(h);
        Before before{0, 0, std::numeric_limits<double>::infinity(), 0};
        count(state_.faces[face_of(h)], before);
        count(state_.faces[face_of(g)], before);
        ring_sum_ = Vec3::Zero();
        const std::uint32_t at_i = mesh_.valence(mesh_.origin(h)) - 2;
        creases_[0] = gather_half(mesh_.turn(h), 0, at_i, before);
        creases_[1] = gather_half(mesh_.turn(g), at_i, all, before);
        before_ = before;
        if constexpr (Policy::kExtended) {
            for (int& creases : creases_) creases += int{mesh_.is_crease(h)};
        }
        ghost_ == kNone ? fan_.close(all) : open_fan(h, all);
        if (policy_.shaped()) before_.excess = excess_before(h);
        if (mends_) slivers_before_ = slivers_before(h);
    }

    /// Of the faces in the fan and of those that vanish.
    [[nodiscard]] std::size_t slivers_before(HalfEdge h) const {
        std::size_t count = 0;
        const auto add = [&](std::uint32_t face) { count += state_.faces[face].stretch < kStretchFloor ? 1 : 0; };
        for (std::size_t t = 0; t < fan_.size(); ++t) add(fan_.face(t));
        for (const HalfEdge side : {h, mesh_.twin(h)}) {
            if (mesh_.origin(prev(side)) != ghost_) add(face_of(side));
        }
        return count;
    }

    /// Takes the ghost and its faces out of what gather() found.
    void open_fan(HalfEdge h, std::size_t all) {
        fan_.open_at(ghost_, all);
        before_ = {0, 0, std::numeric_limits<double>::infinity(), 0, 0};
        for (const HalfEdge side : {h, mesh_.twin(h)}) {
            if (mesh_.origin(prev(side)) == ghost_) continue;
            count(state_.faces[face_of(side)], before_);
            before_.vanishing += 1;
        }
        for (std::size_t t = 0; t < fan_.size(); ++t) count(state_.faces[fan_.face(t)], before_);
    }

    /// Of the faces in the fan and of those that vanish, as they are.
    [[nodiscard]] Excess excess_before(HalfEdge h) const {
        Excess all;
        const auto add = [&](std::uint32_t face) {
            const auto at = [&](HalfEdge corner) { return mesh_.position(mesh_.origin(corner)); };
            all.add(policy_.excess({at(3 * face), at(3 * face + 1), at(3 * face + 2)}));
        };
        for (std::size_t t = 0; t < fan_.size(); ++t) add(fan_.face(t));
        for (const HalfEdge side : {h, mesh_.twin(h)}) {
            if (mesh_.origin(prev(side)) != ghost_) add(face_of(side));
        }
        return all;
    }

    /// Puts faces counter-clockwise from that of `first` into the fan, from place t to `end`. How many of their spokes and the
    /// one behind them are creases. Counts in locals: members would go through memory at every step.
    [[nodiscard]] int gather_half(HalfEdge first, std::size_t t, std::size_t end, Before& before) {
        Before sums = before;
        Vec3 ring_sum = ring_sum_;
        int creases = 0;
        HalfEdge corner = first;
        for (; t < end; corner = mesh_.turn(corner), ++t) {
            if constexpr (Policy::kExtended) creases += int{mesh_.is_crease(corner)};
            const std::uint32_t v = mesh_.target(corner);
            const FaceState& face = state_.faces[face_of(corner)];
            fan_.put(t, v, mesh_.position(v), face_of(corner), face.normal);
            ring_sum += mesh_.position(v);
            count(face, sums);
        }
        if constexpr (Policy::kExtended) creases += int{mesh_.is_crease(corner)};
        before = sums;
        ring_sum_ = ring_sum;
        return creases;
    }

    [[nodiscard]] bool within_tolerance(std::uint32_t i, std::uint32_t j) const {
        return (mesh_.position(i) - mesh_.position(j)).squaredNorm() <= tolerance_square_;
    }

    [[nodiscard]] static bool is_corner(int creases) { return creases > 2; }

    /// Creases neither meet nor end where they did not: two vertices of creases join along a crease only, and two corners never,
    /// unless they are within the tolerance of each other.
    [[nodiscard]] bool keeps_creases(HalfEdge h) const {
        if (within_tolerance(mesh_.origin(h), mesh_.target(h))) return true;
        if (mesh_.is_crease(h)) return !is_corner(creases_[0]) || !is_corner(creases_[1]);
        return creases_[0] == 0 || creases_[1] == 0;
    }

    /// How a collapse changes the valences of the four vertices around the edge: above 1 where they come nearer to 6.
    [[nodiscard]] double evenness(HalfEdge h, std::uint32_t valence_after) const {
        constexpr double kStrength = 0.03;
        const auto excess = [](double valence) { return (valence - 6) * (valence - 6); };
        if (ghost_ != kNone) return evenness_at_boundary(h, valence_after, kStrength);
        const auto valence_of = [this](HalfEdge corner) { return static_cast<double>(mesh_.valence(mesh_.origin(corner))); };
        const HalfEdge g = mesh_.twin(h);
        const double e = valence_of(prev(h)), b = valence_of(prev(g));
        const double before = excess(valence_of(h)) + excess(valence_of(g)) + excess(e) + excess(b);
        const double after = excess(valence_after) + excess(e - 1) + excess(b - 1);
        return std::exp(kStrength * (before - after));
    }

    /// The same where ghosts are about, who do not count: on a boundary 4 edges are even, and the ghost's.
    [[nodiscard]] double evenness_at_boundary(HalfEdge h, std::uint32_t valence_after, double strength) const {
        const auto excess = [this](std::uint32_t v, double valence) {
            if (state_.border.is_ghost(v)) return 0.0;
            const double even = state_.border.ghost_beside(v) == kNone ? 6 : 5;
            return (valence - even) * (valence - even);
        };
        const auto now = [&](std::uint32_t v) { return excess(v, mesh_.valence(v)); };
        const std::uint32_t i = mesh_.origin(h), j = mesh_.target(h);
        const std::uint32_t e = mesh_.origin(prev(h)), b = mesh_.origin(prev(mesh_.twin(h)));
        const std::uint32_t k = state_.border.ghost_beside(i) == kNone ? j : i;
        const double before = now(i) + now(j) + now(e) + now(b);
        const double after = excess(k, valence_after) + excess(e, mesh_.valence(e) - 1.0) + excess(b, mesh_.valence(b) - 1.0);
        return std::exp(strength * (before - after));
    }

    void count(const FaceState& face, Before& sums) const {
        sums.faces += 1;
        sums.stretch_sum += face.stretch;
        sums.stretch_min = std::min(sums.stretch_min, face.stretch);
        sums.weight_sum += policy_.face_weight(face.size);
    }

    const HalfEdgeMesh& mesh_;
    const LocalState& state_;
    const Policy& policy_;
    const Vec3 centre_;
    const double tolerance_square_;
    Fan fan_;
    Vec3 ring_sum_ = Vec3::Zero();  // of the ring's vertices, a ghost too
    Before before_;
    Evaluation valid_;
    std::array<std::uint32_t, 2> ends_{};
    double error_limit_ = 0;  // of the edge at hand
    double evenness_ = 1;
    bool mends_ = false;  // only collapses that leave fewer slivers
    std::optional<Vec3> place_to_mend_;
    std::size_t slivers_before_ = 0;
    std::uint32_t ghost_ = kNone;   // of the boundary that an end of the edge lies on
    std::array<int, 2> creases_{};  // edges at either end that are creases; extended mode only
};

}  // namespace vsplit

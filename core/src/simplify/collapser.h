#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cstdint>
#include <optional>
#include <vector>

#include "simplify/collapse_log.h"
#include "simplify/edge_evaluator.h"
#include "simplify/edge_flipper.h"
#include "simplify/edge_queue.h"
#include "simplify/fan_replacement.h"
#include "simplify/guards.h"
#include "simplify/half_edge_mesh.h"
#include "simplify/mesh_parts.h"

namespace vsplit {

/// A collapse that the guard refused so often is not tried again before all edges are evaluated anew: trying is dear.
inline constexpr std::uint8_t kMostRefusals = 3;

/// Asks for a quadric, which lies in two cache lines, some hundred nanoseconds before it is needed.
inline void prefetch(const Quadric& quadric) {
    __builtin_prefetch(&quadric);
    __builtin_prefetch(&quadric.c);
}

/// Collapses edges of a mesh, or of a part of it, in order of priority, and keeps up all that depends on the mesh. For one
/// thread.
template <class Policy>
class Collapser {
public:
    /// All outlive this. `refusals`: by guards, one an edge, since all edges were evaluated; empty where there are none.
    struct Setting {
        HalfEdgeMesh& mesh;
        LocalState& state;
        const Policy& policy;
        const SimplifyInput& input;
        const PolishLimits& limits;
        std::vector<std::uint8_t>& refusals;
    };

    /// With `within` only what is in that part of it is queued, and nothing else is looked at.
    Collapser(const Setting& setting, const Guards& guards, CollapseLog& log, const MeshParts* within = nullptr,
              MeshParts::Faces faces = {0, kNone})
        : mesh_(setting.mesh),
          state_(setting.state),
          refusals_(setting.refusals),
          guard_(guards.surface),
          log_(log),
          within_(within),
          evaluator_(setting.mesh, setting.state, setting.policy, setting.input),
          creases_(setting.mesh, setting.state, guards.creases, setting.input.crease_cosine),
          flipper_(setting.mesh, setting.state, log, guards, setting.limits, within),
          queue_(3 * faces.begin, 3 * std::min(faces.end, setting.mesh.half_edge_count() / 3)) {}

    [[nodiscard]] EdgeQueue& queue() { return queue_; }
    [[nodiscard]] EdgeEvaluator<Policy>& evaluator() { return evaluator_; }
    [[nodiscard]] CreaseReplacement& creases() { return creases_; }

    /// Of visible faces; the strict mode keeps it up.
    double stretch_sum = 0;

    /// Queues an edge by its priority, or not at all.
    void settle(HalfEdge edge) {
        if (!refusals_.empty() && refusals_[edge] >= kMostRefusals) return;
        const Evaluation evaluation = evaluator_.rank(edge);
        switch (evaluation.verdict) {
            case Evaluation::Verdict::kValid:
                return queue_.set(edge, evaluation.priority);
            case Evaluation::Verdict::kInvalid:
                return queue_.erase(edge);
            case Evaluation::Verdict::kOutOfReach:
                return queue_.set_aside(edge);
        }
    }

    /// The queued edge, if nothing speaks against it by now.
    void collapse(HalfEdge edge) {
        const EdgeStar star = mesh_.star(edge);
        // The fan belongs to the edge evaluated last; this one's is made again, for its place and its faces.
        const Evaluation evaluation = evaluator_.evaluate(edge);
        if (evaluation.verdict != Evaluation::Verdict::kValid) return drop(edge);  // it would pinch the surface
        // Evenness goes by the valences across the edge, whose changes do not reach as far as those of shape.
        assert(Policy::kExtended || evaluation.priority == queue_.priority(mesh_.edge_of(edge)));
        if (!guards_admit(star, evaluation.position)) {
            ++refusals_[edge];
            return drop(edge);  // until its neighbourhood changes
        }
        make_collapse(star, evaluation.position);
    }

    /// Whether an edge collapses to mend the faces beside it: to the place that collapses have else, or to either end or the
    /// middle where the guards refuse that.
    bool collapse_to_mend(HalfEdge edge) {
        const EdgeStar star = mesh_.star(edge);
        const Vec3 a = mesh_.position(mesh_.origin(edge)), b = mesh_.position(mesh_.target(edge));
        for (const std::optional<Vec3>& at :
             {std::optional<Vec3>(), std::optional(a), std::optional(b), std::optional<Vec3>((a + b) / 2)}) {
            const Evaluation evaluation = evaluator_.evaluate_mend(edge, at);
            if (evaluation.verdict != Evaluation::Verdict::kValid || !guards_admit(star, evaluation.position)) continue;
            make_collapse(star, evaluation.position);
            return true;
        }
        return false;
    }

private:
    /// Whether the guards let the edge of `star` collapse to `position`. \pre the evaluator's fan is that of the collapse.
    [[nodiscard]] bool guards_admit(const EdgeStar& star, const Vec3& position) {
        const Fan& fan = evaluator_.fan();
        if (!creases_.try_collapse(star, fan, position)) return false;
        return guard_ == nullptr || replacement_.try_on(*guard_, fan, position, {face_of(star.ij), face_of(star.ji)},
                                                        {mesh_.origin(star.ij), mesh_.origin(star.ji)});
    }

    /// \pre the evaluator's fan is that of the collapse, and the guards let it pass.
    void make_collapse(const EdgeStar& star, const Vec3& position) {
        for (const HalfEdge h : {star.ij, star.je, star.ei, star.ib, star.bj}) drop(h);
        log_.record(mesh_, star, position);
        if constexpr (!Policy::kExtended) stretch_sum -= visible_stretch(face_of(star.ij)) + visible_stretch(face_of(star.ji));
        const std::uint32_t kept = mesh_.origin(star.ij), removed = mesh_.origin(star.ji);
        state_.quadrics[kept] += state_.quadrics[removed];
        state_.border.join(kept, removed);
        if (state_.sizes.given()) state_.sizes.put(kept, state_.sizes.between(mesh_, kept, removed, position));
        mesh_.collapse(star, position);
        creases_.commit();
        if constexpr (Policy::kExtended) mark_new_creases();
        update_faces(kept);
        const std::uint32_t before = mesh_.clock();
        mesh_.touch_around(kept);
        if constexpr (Policy::kExtended) flip_around(kept);
        requeue_around(kept, before);
    }

    [[nodiscard]] double visible_stretch(std::uint32_t face) const {
        return mesh_.visible(face) ? state_.faces[face].stretch : 0;
    }

    /// Those that a crease which went has left its points to.
    void mark_new_creases() {
        for (const HalfEdge edge : creases_.new_creases()) mesh_.mark_crease(edge);
    }

    /// Flips give edges other numbers: those of the faces that changed are taken out of the queue before they come in anew.
    void flip_around(std::uint32_t kept) {
        flipper_.flip_around(kept);
        for (const std::uint32_t face : flipper_.changed_faces()) {
            for (const HalfEdge h : {3 * face, 3 * face + 1, 3 * face + 2}) {
                queue_.erase(h);
                queue_.erase(mesh_.twin(h));
                ring_.push_back(mesh_.origin(h));
            }
        }
        std::sort(ring_.begin(), ring_.end());
        ring_.erase(std::unique(ring_.begin(), ring_.end()), ring_.end());
    }

    void drop(HalfEdge h) { queue_.erase(mesh_.edge_of(h)); }

    void update_faces(std::uint32_t kept) {
        const Fan& fan = evaluator_.fan();
        ring_.assign(1, kept);
        for (std::size_t t = 0; t < fan.ring_size(); ++t) ring_.push_back(fan.vertex(t));
        for (std::size_t t = 0; t < fan.size(); ++t) {
            const std::uint32_t after = fan.vertex(t + 1 < fan.ring_size() ? t + 1 : 0);
            stretch_sum += fan.stretch(t) - state_.faces[fan.face(t)].stretch;
            state_.faces[fan.face(t)] = {fan.normal(t), fan.stretch(t),
                                         state_.sizes.relative(fan.face_size(t), kept, fan.vertex(t), after)};
        }
    }

    /// Whether the edge between two neighbours is for this one to collapse.
    [[nodiscard]] bool is_own(std::uint32_t v, std::uint32_t other) const {
        return within_ == nullptr || (within_->is_deep(v) && within_->is_deep(other));
    }

    /// Every edge with an end in the ring of k, or in that of a flip, has new faces around it, or a neighbour that moved: its
    /// priority is open again. ring_ is what was touched since the mesh's clock showed `before`.
    void requeue_around(std::uint32_t k, std::uint32_t before) {
        open_.clear();
        for (const std::uint32_t v : ring_) {
            // No edge of a hub is valid, so none is queued: a walk around it at every collapse beside it would be for nothing.
            if (mesh_.valence(v) > kValenceCeiling + 1) continue;
            mesh_.for_each_outgoing(v, [&](HalfEdge h) {
                const std::uint32_t other = mesh_.target(h);
                if (!is_own(v, other)) return;
                if (other < v && mesh_.changed_at(other) > before) return;  // both ends are in ring_: once is enough
                const HalfEdge edge = mesh_.edge_of(h);
                // Neither quadric changed unless an end is k: no place came within reach.
                if (queue_.is_aside(edge) && other != k && v != k) return;
                prefetch(state_.quadrics[other]);
                open_.push_back(edge);
            });
        }
        for (const HalfEdge edge : open_) settle(edge);
    }

    HalfEdgeMesh& mesh_;
    LocalState& state_;
    std::vector<std::uint8_t>& refusals_;
    DeviationGuard* const guard_;
    CollapseLog& log_;
    const MeshParts* const within_;
    EdgeEvaluator<Policy> evaluator_;
    FanReplacement replacement_;
    CreaseReplacement creases_;
    EdgeFlipper flipper_;
    EdgeQueue queue_;
    std::vector<std::uint32_t> ring_;  // the vertex of the last collapse and those around it
    std::vector<HalfEdge> open_;       // edges to evaluate again
};

}  // namespace vsplit

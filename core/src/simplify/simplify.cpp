#include "simplify/simplify.h"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <limits>
#include <optional>
#include <utility>

#include "base/release.h"
#include "simplify/collapse_log.h"
#include "simplify/collapser.h"
#include "simplify/half_edge_mesh.h"
#include "simplify/mesh_parts.h"
#include "simplify/parted_collapse.h"
#include "simplify/polish.h"
#include "simplify/settle_creases.h"

namespace vsplit {
namespace {

constexpr std::uint32_t kLookEvery = 64;  // collapses, some 40 evaluations each, between two looks for a cancel
constexpr std::uint32_t kReportEvery = 1024;

// How the extended mode polishes: the dense mesh, checkpoints after each fifth of the faces, and the resolution asked for.
constexpr double kCheckpointShare = 0.8;
constexpr double kFarCheckpointShare = 0.6;  // while far from what is asked for: most moves are made there
constexpr std::uint32_t kFar = 2;            // times the faces asked for
constexpr double kNearShare = 1.05;          // of the faces asked for, polished as long: then slivers left there can still go
constexpr double kStuckShare = 0.98;         // of the faces at the last checkpoint: no use going on
constexpr double kBestShare = 0.97;          // of the best mean stretch so far: no floor asks for more
constexpr int kDenseRelaxations = 3;
constexpr int kCheckpointRelaxations = 2;
constexpr int kFinalRelaxations = 10;
constexpr int kFinalLifts = 4;
constexpr int kCheckpointMends = 1;  // of bounds that are broken; moves cost as many lifts
constexpr int kFinalMends = 8;

/// Points of the source for each face asked for, to measure the deviation by.
constexpr std::uint32_t kPointsAFace = 8;

template <class Policy>
class Simplifier {
public:
    Simplifier(SimplifyInput input, const Policy& policy, const ExecutionContext& context)
        : input_(std::move(input)),
          policy_(policy),
          context_(context),
          mesh_(input_.mesh, input_.ghosts),
          state_(take_initial_state(input_)),
          limits_(limits_of(policy_, input_)),
          refusals_(input_.source ? mesh_.half_edge_count() : 0),
          faces_start_(mesh_.live_faces()),
          guard_(make_guard()),
          crease_guard_(make_crease_guard()),
          collapser_(std::make_unique<Collapser<Policy>>(setting(), guards(), log_)),
          polisher_(mesh_, state_, log_, guards(), limits_) {
        mark_creases();
        release(input_.creases);
        log_.reserve((faces_start_ - std::min(faces_start_, input_.faces_min)) / 2 + 1);
    }

    [[nodiscard]] Expected<MultiresMesh> run() {
        Status done = Policy::kExtended ? collapse_and_polish() : mend_and_collapse();
        if (!done) return done.error();
        context_.report({"simplify", 1, mesh_.live_faces()});
        let_go();
        return log_.build(mesh_);
    }

private:
    /// Leaves the mesh alone: the representation takes as much as the rest did.
    void let_go() {
        release(state_);
        collapser_ = nullptr;
        guard_ = nullptr;
        release(refusals_);
    }

    [[nodiscard]] typename Collapser<Policy>::Setting setting() { return {mesh_, state_, policy_, input_, limits_, refusals_}; }
    [[nodiscard]] Guards guards() const { return {guard_.get(), crease_guard_.get()}; }

    [[nodiscard]] static PolishLimits limits_of(const Policy& policy, const SimplifyInput& input) {
        PolishLimits limits{.centre = input.centre, .tolerance = input.tolerance, .crease_cosine = input.crease_cosine};
        if constexpr (requires { policy.max_valence; }) {
            limits.max_size = policy.max_size;
            limits.max_valence = policy.max_valence;
        }
        limits.bounds = policy;
        return limits;
    }

    /// Bounds beside that on stretch, whose violators the phases of the paper mend.
    [[nodiscard]] bool bounds_need_mending() const {
        if constexpr (requires { policy_.max_valence; }) {
            return policy_.shaped() || policy_.max_valence < std::numeric_limits<std::uint32_t>::max();
        }
        return false;
    }

    /// At the resolution asked for, or the last one.
    void polish_asked() {
        polisher_.polish(kFinalRelaxations, VertexMover::Moves::kAll, kFinalLifts, context_);
        polisher_.mend(kFinalMends, true, context_);
        collapse_slivers();
    }

    [[nodiscard]] bool is_sliver(std::uint32_t face) const {
        return mesh_.visible(face) && state_.faces[face].stretch < kStretchFloor;
    }

    /// Collapses edges of slivers where that leaves fewer of them, the shortest first, down to the faces asked for. Creases may
    /// go flatter than on the way: these steps are the last.
    void collapse_slivers() {
        slivers_ = 0;
        if (!has_collapses_above(input_.faces)) return;
        for (std::uint32_t face = 0; 3 * face < mesh_.half_edge_count(); ++face) slivers_ += is_sliver(face) ? 1 : 0;
        if (slivers_ == 0) return;
        collapser_->queue().clear();
        if (crease_guard_) settle_creases(mesh_, state_, *crease_guard_, input_.crease_cosine);
        collapser_->creases().let_flatten(true);
        for (std::uint32_t face = 0; 3 * face < mesh_.half_edge_count() && !context_.cancelled(); ++face) {
            if (is_sliver(face)) collapse_sliver(face);
        }
        collapser_->creases().let_flatten(false);
    }

    void collapse_sliver(std::uint32_t face) {
        std::array<HalfEdge, 3> sides{3 * face, 3 * face + 1, 3 * face + 2};
        const auto square = [this](HalfEdge h) {
            return (mesh_.position(mesh_.target(h)) - mesh_.position(mesh_.origin(h))).squaredNorm();
        };
        std::sort(sides.begin(), sides.end(),
                  [&](HalfEdge l, HalfEdge r) { return std::pair(square(l), l) < std::pair(square(r), r); });
        for (const HalfEdge side : sides) {
            if (!has_collapses_above(input_.faces) || collapser_->collapse_to_mend(side)) return;
        }
    }

    /// On the way there and beyond. Vertices of too many edges are seldom mended later: faces around them have no room.
    void polish_passing(int relaxations) {
        polisher_.polish(relaxations, VertexMover::Moves::kWorthwhile, 0, context_);
        if (bounds_need_mending()) polisher_.mend(kCheckpointMends, true, context_);
    }

    [[nodiscard]] std::unique_ptr<DeviationGuard> make_guard() const {
        if (!input_.source) return nullptr;
        return std::make_unique<DeviationGuard>(mesh_, *input_.source, input_.max_deviation,
                                                kPointsAFace * std::min(input_.faces, mesh_.live_faces()), state_.border);
    }

    [[nodiscard]] std::unique_ptr<CreaseGuard> make_crease_guard() const {
        if (!input_.source || input_.creases.empty()) return nullptr;
        return std::make_unique<CreaseGuard>(mesh_, input_.creases, input_.max_deviation);
    }

    void mark_creases() {
        for (const SharpEdge& crease : input_.creases) {
            mesh_.for_each_outgoing(crease.a, [&](HalfEdge h) {
                if (mesh_.target(h) == crease.b) mark_crease(h);
            });
        }
    }

    void mark_crease(HalfEdge h) {
        const HalfEdge g = mesh_.twin(h);
        const bool inside = !state_.border.is_ghost(mesh_.origin(prev(h))) && !state_.border.is_ghost(mesh_.origin(prev(g)));
        const float cosine = state_.faces[face_of(h)].normal.dot(state_.faces[face_of(g)].normal);
        if (inside && cosine < input_.crease_cosine) {
            mesh_.mark_crease(h);
        } else {
            mesh_.mark_kept_flat(h);
        }
    }

    /// Whether a collapse leaves no fewer than `faces`.
    [[nodiscard]] bool has_collapses_above(std::uint32_t faces) const { return mesh_.live_faces() >= std::uint64_t{faces} + 2; }

    /// From checkpoint to checkpoint, so that no resolution is far from a polished one, until shape suffers.
    [[nodiscard]] Status collapse_and_polish() {
        polish_passing(kDenseRelaxations);
        double mean = mean_stretch(), best = mean;
        for (std::uint32_t faces = mesh_.live_faces(); has_collapses_above(input_.faces_min);) {
            const std::uint32_t goal = next_checkpoint(faces);
            if (Status done = collapse_in_phases(goal); !done) return done;
            // Polishing makes some more collapses valid, but ever fewer.
            const bool stuck = has_collapses_above(goal) && mesh_.live_faces() > kStuckShare * faces;
            const bool asked = is_near_asked(goal) || (stuck && mesh_.live_faces() > input_.faces);
            asked ? polish_asked() : polish_passing(kCheckpointRelaxations);
            if (context_.cancelled()) return ExecutionContext::cancelled_error();
            if (stuck) break;
            const double before = std::exchange(mean, mean_stretch());
            best = std::max(best, mean);
            if (would_fall_below(std::min(input_.mean_floor, kBestShare * best), before, mean)) {
                if (mesh_.live_faces() > input_.faces) polish_asked();
                break;
            }
            faces = mesh_.live_faces();
        }
        return Done{};
    }

    /// Whether the next checkpoint is to be expected under a floor, going by the mean stretch at the last two. What never came up
    /// to it does not fall below it.
    [[nodiscard]] bool would_fall_below(double floor, double before, double now) const {
        return mesh_.live_faces() <= input_.floor_from && before >= floor && 2 * now - before < floor;
    }

    /// The strict mode: flips only, only before the first collapse, and only where a bound is broken that collapses hardly mend.
    [[nodiscard]] Status mend_and_collapse() {
        if (bounds_need_mending()) polisher_.mend(kFinalMends, false, context_);
        collapser_->stretch_sum = stretch_sum();
        return collapse_in_phases(input_.faces_min);
    }

    [[nodiscard]] double stretch_sum() const {
        double sum = 0;
        for (std::uint32_t face = 0; 3 * face < mesh_.half_edge_count(); ++face) sum += visible_stretch(face);
        return sum;
    }

    [[nodiscard]] double visible_stretch(std::uint32_t face) const {
        return mesh_.visible(face) ? state_.faces[face].stretch : 0;
    }

    [[nodiscard]] double mean_stretch() const { return stretch_sum() / mesh_.live_faces(); }

    /// The strict mode's, after each collapse. What never came up to the floor does not fall below it.
    [[nodiscard]] bool is_below_floor() {
        const bool below = collapser_->stretch_sum < input_.mean_floor * mesh_.live_faces();
        reached_floor_ |= !below;
        return below && reached_floor_ && mesh_.live_faces() <= input_.floor_from;
    }

    [[nodiscard]] bool is_near_asked(std::uint32_t faces) const {
        return faces >= input_.faces && faces <= kNearShare * input_.faces;
    }

    /// A fifth of the faces fewer, or more while far from what is asked for; and the resolution asked for in any case, after one
    /// near it.
    [[nodiscard]] std::uint32_t next_checkpoint(std::uint32_t faces) {
        const bool may_end_here = input_.mean_floor > 0 && faces <= input_.floor_from;
        const double share = faces / kFar > input_.faces && !may_end_here ? kFarCheckpointShare : kCheckpointShare;
        const auto goal = static_cast<std::uint32_t>(share * faces);
        const bool passes_asked = has_collapses_above(input_.faces) && goal < 1.1 * input_.faces;
        if (!passes_asked) return std::max(goal, input_.faces_min);
        const auto near = static_cast<std::uint32_t>(kNearShare * input_.faces);
        if (has_collapses_above(near)) return std::max(near, input_.faces_min);
        // Slivers that can go then leave as many faces as were asked for.
        const std::uint32_t room = std::exchange(made_room_, true) ? input_.faces : input_.faces + 2 * slivers_;
        return std::max(has_collapses_above(room) ? room : input_.faces, input_.faces_min);
    }

    [[nodiscard]] Status collapse_in_phases(std::uint32_t faces) {
        if (policy_.two_phases()) {
            policy_.enter_phase(1);
            if (Status done = collapse_all(faces); !done) return done;
            policy_.enter_phase(2);
        }
        return collapse_all(faces);
    }

    /// Fills the queue, then collapses from its top until it is empty or the mesh has no more than `faces`; of a large mesh first
    /// in parts.
    [[nodiscard]] Status collapse_all(std::uint32_t faces) {
        if constexpr (Policy::kExtended) {
            collapse_in_parts(faces);
            if (context_.cancelled()) return ExecutionContext::cancelled_error();
        }
        if (Status queued = evaluate_all_edges(); !queued) return queued;
        std::uint32_t collapses = 0;
        while (has_collapses_above(faces)) {
            const HalfEdge edge = collapser_->queue().top();
            if (edge == kNone || (!Policy::kExtended && is_below_floor())) break;
            collapser_->collapse(edge);
            if (++collapses % kLookEvery == 0 && context_.cancelled()) return ExecutionContext::cancelled_error();
            if (collapses % kReportEvery == 0) report_simplified();
        }
        return Done{};
    }

    /// Those that are deep in their part, as many as are theirs of the collapses to come. The rest makes things even: where parts
    /// did more, by a second cut elsewhere, shape was worse (docs/profile.md).
    void collapse_in_parts(std::uint32_t faces) {
        const MeshParts parts(mesh_, shifted_ = !shifted_);
        if (parts.count() == 1 || !has_collapses_above(faces)) return;
        std::fill(refusals_.begin(), refusals_.end(), std::uint8_t{0});
        report_evaluated(0);
        collapser_->queue() = EdgeQueue(0, 0);  // its memory goes to those of the parts
        const double collapses = parts.deep_share() * (mesh_.live_faces() - faces) / 2;
        PartedCollapse<Policy>(setting(), guards(), log_, parts, context_).run(static_cast<std::size_t>(collapses), [this] {
            note_evaluated();
            report_simplified();
        });
        collapser_->queue() = EdgeQueue(0, mesh_.half_edge_count());
    }

    /// Evaluates every edge, on all threads the context allows: each depends only on the mesh as it stands.
    [[nodiscard]] Status evaluate_all_edges() {
        EdgeQueue& queue = collapser_->queue();
        queue.clear();
        std::fill(refusals_.begin(), refusals_.end(), std::uint8_t{0});
        tbb::enumerable_thread_specific<EdgeEvaluator<Policy>> evaluators(
            [&] { return EdgeEvaluator<Policy>(mesh_, state_, policy_, input_); });
        report_evaluated(0);
        const auto evaluate_range = [&](const tbb::blocked_range<HalfEdge>& range) {
            if (context_.cancelled()) return;
            EdgeEvaluator<Policy>& evaluator = evaluators.local();
            for (HalfEdge h = range.begin(); h < range.end(); ++h) {
                if (mesh_.removed(h) || mesh_.edge_of(h) != h) continue;
                const Evaluation evaluation = evaluator.rank(h);
                if (evaluation.verdict == Evaluation::Verdict::kValid) queue.enter(h, evaluation.priority);
                if (evaluation.verdict == Evaluation::Verdict::kOutOfReach) queue.enter_aside(h);
            }
        };
        tbb::parallel_for(tbb::blocked_range<HalfEdge>(0, mesh_.half_edge_count(), 2048), evaluate_range);
        if (context_.cancelled()) return ExecutionContext::cancelled_error();
        note_evaluated();
        queue.open_all();
        return Done{};
    }

    /// Stages follow one another: evaluating again between collapses is part of simplifying.
    void report_evaluated(double fraction) const {
        if (!evaluated_) context_.report({"evaluate", fraction, mesh_.live_faces()});
    }

    void note_evaluated() {
        report_evaluated(1);
        evaluated_ = true;
    }

    void report_simplified() const {
        const double all = faces_start_ - std::min(faces_start_, input_.faces_min);
        context_.report({"simplify", all > 0 ? (faces_start_ - mesh_.live_faces()) / all : 1, mesh_.live_faces()});
    }

    SimplifyInput input_;
    Policy policy_;
    const ExecutionContext& context_;
    HalfEdgeMesh mesh_;
    LocalState state_;
    PolishLimits limits_;
    std::vector<std::uint8_t> refusals_;  // see Collapser
    CollapseLog log_;
    std::uint32_t faces_start_ = 0;
    bool reached_floor_ = false;
    std::uint32_t slivers_ = 0;  // at the last polish near the faces asked for
    bool made_room_ = false;
    bool evaluated_ = false;                     // all edges, once
    bool shifted_ = false;                       // where the mesh was cut last
    std::unique_ptr<DeviationGuard> guard_;      // null where there is no bound
    std::unique_ptr<CreaseGuard> crease_guard_;  // null there too, or without creases
    std::unique_ptr<Collapser<Policy>> collapser_;
    Polisher polisher_;
};

}  // namespace

Expected<MultiresMesh> simplify(SimplifyInput input, const ImprovePolicy& policy, const ExecutionContext& context) {
    return Simplifier<ImprovePolicy>(std::move(input), policy, context).run();
}

Expected<MultiresMesh> simplify(SimplifyInput input, const ControlPolicy& policy, const ExecutionContext& context) {
    return Simplifier<ControlPolicy>(std::move(input), policy, context).run();
}

Expected<MultiresMesh> simplify(SimplifyInput input, const Extended<ImprovePolicy>& policy, const ExecutionContext& context) {
    return Simplifier<Extended<ImprovePolicy>>(std::move(input), policy, context).run();
}

Expected<MultiresMesh> simplify(SimplifyInput input, const Extended<ControlPolicy>& policy, const ExecutionContext& context) {
    return Simplifier<Extended<ControlPolicy>>(std::move(input), policy, context).run();
}

}  // namespace vsplit

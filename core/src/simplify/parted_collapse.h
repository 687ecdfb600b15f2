#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "simplify/collapser.h"
#include "simplify/log_in_parts.h"
#include "vsplit/base/execution_context.h"

namespace vsplit {

/// Collapses edges inside the parts of a mesh, all parts at the same time, nearly in the order that one queue for all would give:
/// in rounds, in each of which every part collapses what is over one bound on the priority, the same for all.
template <class Policy>
class PartedCollapse {
public:
    using Setting = typename Collapser<Policy>::Setting;

    /// All outlive this.
    PartedCollapse(const Setting& setting, const Guards& guards, CollapseLog& log, const MeshParts& parts,
                   const ExecutionContext& context)
        : setting_(setting), guards_(guards), log_(log), parts_(parts), context_(context), hands_(parts.count()) {}

    /// No more than `collapses`, and nearly as many where a few rounds find them; `after_round()` after each. Stops early when
    /// cancelled.
    template <class AfterRound>
    void run(std::size_t collapses, AfterRound after_round) {
        start();
        const std::size_t enough = collapses / kEnough;
        for (int round = 0; round < kMostRounds && collapses > enough && !context_.cancelled(); ++round) {
            const double bound = find_bound(collapses);
            if (bound < 0) break;
            in_parallel(hands_.size(), [&](std::size_t part) { hands_[part]->collapse_over(bound, context_); });
            for (const auto& hand : hands_) collapses -= hand->made;
            after_round();
        }
        for (const auto& hand : hands_) log_.append(std::move(hand->log));
    }

private:
    static constexpr int kMostRounds = 8;
    static constexpr std::size_t kEnough = 20;  // a twentieth is left to who comes after

    /// What a part is worked on with.
    struct Hand {
        OwnGuards guards;
        CollapseLog log;
        Collapser<Policy> collapser;
        std::vector<double> priorities;  // of what is queued
        std::size_t made = 0;            // collapses of the last round

        Hand(const Setting& setting, const Guards& given, CollapseLog fork, const MeshParts& parts, std::size_t part)
            : guards(given), log(std::move(fork)), collapser(setting, guards.all(), log, &parts, parts.faces(part)) {
            const HalfEdgeMesh& mesh = setting.mesh;
            const MeshParts::Faces faces = parts.faces(part);
            for (HalfEdge h = 3 * faces.begin; h < 3 * faces.end; ++h) {
                if (mesh.removed(h) || mesh.edge_of(h) != h) continue;
                if (parts.is_deep(mesh.origin(h)) && parts.is_deep(mesh.target(h))) collapser.settle(h);
            }
            note_priorities();
        }

        void note_priorities() {
            priorities.clear();
            collapser.queue().for_each([this](double priority) { priorities.push_back(priority); });
        }

        /// As many as were over the bound before, at most.
        void collapse_over(double bound, const ExecutionContext& context) {
            constexpr std::size_t kLookEvery = 64;
            const auto most = static_cast<std::size_t>(
                std::count_if(priorities.begin(), priorities.end(), [bound](double priority) { return priority >= bound; }));
            const std::size_t before = log.size();
            for (made = 0; made < most; made = log.size() - before) {
                const HalfEdge edge = collapser.queue().top();
                if (edge == kNone || collapser.queue().priority(edge) < bound) break;
                if (made % kLookEvery == 0 && context.cancelled()) break;
                collapser.collapse(edge);
            }
            note_priorities();
        }
    };

    void start() {
        log_.end_step(setting_.mesh);
        std::vector<CollapseLog> forks;
        for (std::size_t part = 0; part < hands_.size(); ++part) forks.push_back(log_.fork(setting_.mesh));
        in_parallel(hands_.size(), [&](std::size_t part) {
            hands_[part] = std::make_unique<Hand>(setting_, guards_, std::move(forks[part]), parts_, part);
        });
    }

    /// The priority that `count` edges reach; the least there is, or under 0 where none is queued.
    [[nodiscard]] double find_bound(std::size_t count) {
        all_.clear();
        for (const auto& hand : hands_) all_.insert(all_.end(), hand->priorities.begin(), hand->priorities.end());
        if (all_.empty()) return -1;
        const auto at = all_.begin() + static_cast<std::ptrdiff_t>(std::min(count, all_.size()) - 1);
        std::nth_element(all_.begin(), at, all_.end(), std::greater<>());
        return *at;
    }

    const Setting setting_;
    const Guards guards_;
    CollapseLog& log_;
    const MeshParts& parts_;
    const ExecutionContext& context_;
    std::vector<std::unique_ptr<Hand>> hands_;
    std::vector<double> all_;  // priorities of all parts
};

}  // namespace vsplit

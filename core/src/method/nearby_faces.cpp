#include "method/nearby_faces.h"

#include <algorithm>
#include <utility>

#include "vsplit/method/control.h"
#include "vsplit/mrr/progressive_mesh.h"

namespace vsplit {
namespace {

constexpr double kNearShare = 0.1;
constexpr double kCoarsestShare = 0.5;

/// Goes from level to level, which is cheaper than beginning at the base each time.
class LevelWalker {
public:
    explicit LevelWalker(const MultiresMesh& mrr) : mrr_(mrr), mesh_(ProgressiveMesh::from_base(mrr.base, mrr.ghosts)) {}

    /// \return an empty mesh where the MRR is none, which the simplifier does not make.
    [[nodiscard]] TriangleMesh at(std::size_t level) {
        if (!mesh_) return {};
        if (level < mesh_->level()) mesh_->coarsen(mesh_->level() - level);
        const std::size_t to = mrr_.record_of_level(level);
        if (!mesh_->refine(mrr_.records.slice(mesh_->records(), to - mesh_->records()))) return {};
        return mesh_->visible();
    }

private:
    const MultiresMesh& mrr_;
    Expected<ProgressiveMesh> mesh_;
};

/// The coarsest and the finest level that are near enough.
std::pair<std::size_t, std::size_t> range(const MultiresMesh& mrr, double faces, bool given, bool any_coarser) {
    const auto level = [&](double of_faces) { return mrr.level_for(static_cast<std::uint32_t>(std::min(of_faces, 4e9))); };
    if (given) return {level((1 - kNearShare) * faces), level((1 + kNearShare) * faces)};
    return {any_coarser ? 0 : level(kCoarsestShare * faces), mrr.levels()};
}

}  // namespace

std::uint32_t faces_that_keep_bounds(const MultiresMesh& mrr, const ControlOptions& options, bool given) {
    const std::uint32_t faces = *options.faces;
    const std::size_t asked = mrr.level_for(faces);
    const auto [coarsest, finest] = range(mrr, faces, given, options.min_size.has_value());
    LevelWalker walker(mrr);
    const auto holds = [&](std::size_t level) { return find_violations(walker.at(level), options).empty(); };
    if (holds(asked)) return faces;
    for (std::size_t step = 1; asked + step <= finest || coarsest + step <= asked; step *= 2) {
        if (asked + step <= finest && holds(asked + step)) return mrr.faces_at(asked + step);
        if (coarsest + step <= asked && holds(asked - step)) return mrr.faces_at(asked - step);
    }
    return faces;
}

}  // namespace vsplit

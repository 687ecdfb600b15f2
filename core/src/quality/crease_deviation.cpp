#include "vsplit/quality/crease_deviation.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "base/number_text.h"
#include "base/thread_limit.h"
#include "quality/deviation_of_index.h"
#include "vsplit/features/face_normals.h"
#include "vsplit/features/sharp_edges.h"

namespace vsplit {
namespace {

constexpr double kDefaultLostDistance = 2e-3;  ///< of the diagonal
constexpr double kMostSamples = 1e8;

std::vector<EdgeEnds> creases_of(const TriangleMesh& mesh, double angle) {
    std::vector<EdgeEnds> creases;
    for (const SharpEdge& edge : find_sharp_edges(mesh, face_normals(mesh), {.angle = angle, .weight = 1})) {
        creases.push_back({edge.a, edge.b});
    }
    return creases;
}

Status check_length(double value, const char* name, const char* field) {
    if (value >= 0 && std::isfinite(value)) return Done{};
    return Error{Cause::kInvalidOption, std::string(name) + " is " + number_text(value) + "; a length of 0 or more is accepted",
                 field};
}

/// Checks all but the accuracy, and fills in the defaults.
Expected<CreaseDeviationOptions> complete(CreaseDeviationOptions options, double diagonal) {
    if (!(options.angle >= 0 && options.angle <= 180)) {
        return Error{Cause::kInvalidOption, "the angle is " + number_text(options.angle) + "; 0 to 180 degrees are accepted",
                     "angle"};
    }
    if (Status valid = check_length(options.lost_distance, "the distance of a lost crease", "lost_distance"); !valid) {
        return valid.error();
    }
    if (Status valid = check_length(options.spacing, "the spacing of samples", "spacing"); !valid) return valid.error();
    if (options.lost_distance == 0) options.lost_distance = kDefaultLostDistance * diagonal;
    if (options.spacing == 0) options.spacing = options.lost_distance / 2;
    return options;
}

/// Evenly spread samples, each in the middle of what it stands for.
class CreaseSamples {
public:
    CreaseSamples(const TriangleMesh& mesh, const std::vector<EdgeEnds>& creases, double spacing)
        : mesh_(mesh), creases_(creases), spacing_(spacing) {}

    /// A bound of how many there are.
    [[nodiscard]] double count() const {
        double sum = 0;
        for (const EdgeEnds& crease : creases_) sum += length(crease) / spacing_ + 1;
        return sum;
    }

    /// The share of the creases' length further than `distance` from those of `to`.
    [[nodiscard]] double share_beyond(double distance, const CreaseIndex& to) const {
        std::vector<double> lost(creases_.size());
        tbb::parallel_for(std::size_t{0}, creases_.size(), [&](std::size_t i) { lost[i] = lost_of(creases_[i], distance, to); });
        double all = 0;
        double sum = 0;
        for (std::size_t i = 0; i < creases_.size(); ++i) {
            all += length(creases_[i]);
            sum += lost[i];
        }
        return all > 0 ? sum / all : 0;
    }

private:
    [[nodiscard]] double length(const EdgeEnds& crease) const {
        return (mesh_.positions[crease[1]] - mesh_.positions[crease[0]]).norm();
    }

    [[nodiscard]] double lost_of(const EdgeEnds& crease, double distance, const CreaseIndex& to) const {
        const double whole = length(crease);
        const auto samples = static_cast<std::uint32_t>(std::max(1.0, std::ceil(whole / spacing_)));
        const Vec3& start = mesh_.positions[crease[0]];
        const Vec3 along = mesh_.positions[crease[1]] - start;
        std::uint32_t beyond = 0;
        for (std::uint32_t i = 0; i < samples; ++i) {
            const Vec3 p = start + along * ((i + 0.5) / samples);
            beyond += to.closest(p, distance * distance).element == CreaseIndex::kNoElement ? 1 : 0;
        }
        return whole * beyond / samples;
    }

    const TriangleMesh& mesh_;
    const std::vector<EdgeEnds>& creases_;
    double spacing_;
};

Expected<CreaseDeviation> measure_creases(const TriangleMesh& result, const TriangleMesh& source,
                                          const CreaseDeviationOptions& options, const ExecutionContext& context) {
    const std::vector<EdgeEnds> from = creases_of(source, options.angle);
    const std::vector<EdgeEnds> to = creases_of(result, options.angle);
    const Expected<SearchLimits> limits =
        search_limits(options.accuracy, bounding_box(source).diagonal(), std::uint64_t{from.size()} + to.size());
    if (!limits) return limits.error();
    const CreaseSamples samples(source, from, options.spacing);
    if (!from.empty() && !(samples.count() <= kMostSamples)) {
        return Error{Cause::kLimitExceeded,
                     "a spacing of " + number_text(options.spacing) + " makes more than 10^8 samples, the limit", "spacing"};
    }
    const CreaseIndex index = crease_index(result.positions, to);
    const auto tell = [&](double fraction) { context.report({"measure", fraction, result.face_count()}); };
    const Expected<DirectedDeviation> distance =
        directed_deviation<SegmentShape>({source.positions, from}, index, *limits, context, tell);
    if (!distance) return distance.error();
    const double lost = samples.share_beyond(options.lost_distance, index);
    if (context.cancelled()) return ExecutionContext::cancelled_error();
    tell(1);
    return CreaseDeviation{static_cast<std::uint32_t>(from.size()), static_cast<std::uint32_t>(to.size()), *distance, lost};
}

}  // namespace

Expected<CreaseDeviation> measure_crease_deviation(const TriangleMesh& result, const TriangleMesh& source,
                                                   const CreaseDeviationOptions& options, const ExecutionContext& context) {
    if (Status some = require_faces(result, "result"); !some) return some.error();
    if (Status some = require_faces(source, "source"); !some) return some.error();
    const Expected<CreaseDeviationOptions> completed = complete(options, bounding_box(source).diagonal());
    if (!completed) return completed.error();
    return with_thread_limit(context, [&] { return measure_creases(result, source, *completed, context); });
}

}  // namespace vsplit

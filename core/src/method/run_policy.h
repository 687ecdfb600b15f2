#pragma once

#include <algorithm>
#include <optional>
#include <utility>

#include "method/method_run.h"
#include "method/report_creases.h"

namespace vsplit {

/// One attempt of `run_policy`, with samples kept to `share` of max_deviation.
template <class Policy, class Faces>
[[nodiscard]] Expected<MethodResult> attempt_policy(const TriangleMesh& source, SubdividedMesh dense, const MethodRun& run,
                                                    double share, bool last, const Policy& policy, Faces faces_of,
                                                    const ExecutionContext& context) {
    if (context.cancelled()) return ExecutionContext::cancelled_error();
    SimplifyInput input = prepare(source, std::move(dense), run.prepare);
    if (context.cancelled()) return ExecutionContext::cancelled_error();
    const Reference reference = reference_for(source, run.prepare.replaced);
    if (run.extended) {
        if (Status guarded = guard(input, reference, share * run.max_deviation, context); !guarded) return guarded.error();
    }
    const std::shared_ptr<const SurfaceIndex> index = input.source;
    Expected<MultiresMesh> mrr = run.extended ? simplify(std::move(input), Extended<Policy>{policy}, context)
                                              : simplify(std::move(input), policy, context);
    if (!mrr) return mrr.error();
    const std::uint32_t faces = faces_of(*mrr);
    MethodResult result = describe_resolution(std::move(*mrr), faces);
    const Status measured = measure(result, reference, index.get(), run.limit, last, context);
    if (!measured) return measured.error();
    if (const Status told = report_creases(result, source, index.get(), run, context); !told) return told.error();
    return result;
}

/// Whether surface and creases are within max_deviation.
[[nodiscard]] inline bool keeps_deviation(const MethodResult& result, const MethodRun& run) {
    return furthest(result) <= run.max_deviation;
}

/// Simplifies, shows the resolution that `faces_of(mrr)` names, and measures. What lies between samples may be further away than
/// they: where max_deviation is not kept at that resolution, it is tried again with less. If it was given it is so once more, and
/// the last time finer resolutions count too; a default gives way then (see `deviation_kept`).
template <class Policy, class Faces>
[[nodiscard]] Expected<MethodResult> run_policy(const TriangleMesh& source, SubdividedMesh dense, const MethodRun& run,
                                                const Policy& policy, Faces faces_of, const ExecutionContext& context) {
    constexpr double kFirstShare = 0.75;
    const double last_share = kFirstShare / (run.limit ? 4 : 2);
    double share = kFirstShare;
    for (; run.extended && share > last_share; share /= 2) {
        Expected<MethodResult> result = attempt_policy(source, dense, run, share, false, policy, faces_of, context);
        if (!result || keeps_deviation(*result, run)) return result;
    }
    return attempt_policy(source, std::move(dense), run, share, true, policy, faces_of, context);
}

}  // namespace vsplit

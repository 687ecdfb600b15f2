#include "vsplit/quality/deviation.h"

#include <cmath>
#include <string>

#include "base/number_text.h"
#include "base/thread_limit.h"
#include "quality/deviation_of_index.h"

namespace vsplit {
namespace {

constexpr double kDefaultAbsoluteError = 1e-5;  ///< of the diagonal
constexpr std::uint64_t kDefaultEvaluations = 1'000'000;
constexpr std::uint64_t kDefaultEvaluationsPerElement = 200;

SearchProgress reporter(const ExecutionContext& context, double from, double to, std::uint32_t faces) {
    return [&context, from, to, faces](double fraction) { context.report({"measure", from + (to - from) * fraction, faces}); };
}

ShapesOf<TriangleShape> faces_of(const TriangleMesh& mesh) { return {mesh.positions, mesh.faces}; }

Expected<Deviation> measure_both(const IndexedMesh& result, const IndexedMesh& source, const DeviationOptions& options,
                                 const ExecutionContext& context) {
    const Expected<SearchLimits> limits = search_limits(options, bounding_box(source.mesh).diagonal(),
                                                        std::uint64_t{result.mesh.face_count()} + source.mesh.face_count());
    if (!limits) return limits.error();
    const std::uint32_t faces = result.mesh.face_count();
    const Expected<DirectedDeviation> to_source =
        directed_deviation(faces_of(result.mesh), source.index, *limits, context, reporter(context, 0, 0.5, faces));
    if (!to_source) return to_source.error();
    const Expected<DirectedDeviation> from_source =
        directed_deviation(faces_of(source.mesh), result.index, *limits, context, reporter(context, 0.5, 1, faces));
    if (!from_source) return from_source.error();
    context.report({"measure", 1, faces});
    return Deviation{*to_source, *from_source};
}

}  // namespace

Status require_faces(const TriangleMesh& mesh, const char* which) {
    if (!mesh.faces.empty()) return Done{};
    return Error{Cause::kEmptyInput, std::string("the ") + which + " has no faces; a distance needs at least one on either side",
                 ""};
}

Expected<SearchLimits> search_limits(const DeviationOptions& options, double diagonal, std::uint64_t elements) {
    if (!(options.relative_error >= 0 && options.relative_error <= 1)) {
        return Error{Cause::kInvalidOption,
                     "the relative error is " + number_text(options.relative_error) + "; 0 to 1 is accepted", "relative_error"};
    }
    if (!(options.absolute_error >= 0) || !std::isfinite(options.absolute_error)) {
        return Error{Cause::kInvalidOption,
                     "the absolute error is " + number_text(options.absolute_error) + "; a length of 0 or more is accepted",
                     "absolute_error"};
    }
    SearchLimits limits{options.relative_error, options.absolute_error, options.evaluations};
    if (limits.absolute_error == 0) limits.absolute_error = kDefaultAbsoluteError * diagonal;
    if (limits.evaluations == 0) limits.evaluations = kDefaultEvaluations + kDefaultEvaluationsPerElement * elements;
    return limits;
}

Expected<Deviation> measure_deviation(const IndexedMesh& result, const IndexedMesh& source, const DeviationOptions& options,
                                      const ExecutionContext& context) {
    if (Status some = require_faces(result.mesh, "result"); !some) return some.error();
    if (Status some = require_faces(source.mesh, "source"); !some) return some.error();
    return with_thread_limit(context, [&] { return measure_both(result, source, options, context); });
}

Expected<DirectedDeviation> measure_directed_deviation(const TriangleMesh& from, const SurfaceIndex& to, double diagonal,
                                                       const DeviationOptions& options, const ExecutionContext& context) {
    const Expected<SearchLimits> limits = search_limits(options, diagonal, from.faces.size() + to.size());
    if (!limits) return limits.error();
    return with_thread_limit(context, [&] {
        return directed_deviation(faces_of(from), to, *limits, context, reporter(context, 0, 1, from.face_count()));
    });
}

Expected<Deviation> measure_deviation(const TriangleMesh& result, const TriangleMesh& source, const DeviationOptions& options,
                                      const ExecutionContext& context) {
    if (Status some = require_faces(result, "result"); !some) return some.error();
    if (Status some = require_faces(source, "source"); !some) return some.error();
    return with_thread_limit(context, [&]() -> Expected<Deviation> {
        if (context.cancelled()) return ExecutionContext::cancelled_error();
        const SurfaceIndex source_index = surface_index(source);
        if (context.cancelled()) return ExecutionContext::cancelled_error();
        const SurfaceIndex result_index = surface_index(result);
        return measure_both({result, result_index}, {source, source_index}, options, context);
    });
}

}  // namespace vsplit

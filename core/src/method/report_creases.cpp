#include "method/report_creases.h"

#include "quality/kept_creases.h"
#include "quality/sliver_mends.h"
#include "quality/sliver_source.h"
#include "vsplit/mrr/progressive_mesh.h"

namespace vsplit {
namespace {}  // namespace

Status report_creases(MethodResult& result, const TriangleMesh& source, const SurfaceIndex* surface, const MethodRun& run,
                      const ExecutionContext& context) {
    if (!run.extended && result.quality.faces_below_02 == 0) return Done{};
    const TriangleMesh mesh = mesh_at(result.mrr, result.mrr.level_for(result.faces));
    const std::vector<SharpEdge> creases = find_creases(source, face_normals(source), run.prepare.features);
    const double angle = kCreaseBendShare * run.prepare.features.angle;
    if (run.extended) {
        const DeviationOptions accuracy = accuracy_for(run.limit, bounding_box(source).diagonal());
        const auto deviation = measure_kept_creases(mesh, source, creases, angle, accuracy, context);
        if (!deviation) return deviation.error();
        if (*deviation) result.quality.crease_deviation_max = (*deviation)->upper;
    }
    if (result.quality.faces_below_02 == 0) return Done{};
    const double distance = run.extended ? run.max_deviation : run.prepare.tolerance;
    const std::vector<SharpEdge> kept = creases_kept(mesh, source, creases, angle, distance);
    const SliverOptions options{.edge = 0, .max_deviation = run.max_deviation, .crease_angle = run.prepare.features.angle};
    result.slivers = surface == nullptr ? explain_slivers(mesh, kept, options)
                                        : explain_slivers(mesh, kept, options, SliverSource{*surface, source, creases});
    return Done{};
}

}  // namespace vsplit

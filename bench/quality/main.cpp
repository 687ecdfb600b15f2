/// What the comparison of scripts/bench_quality needs from one result: prints one line of JSON.
///
///     bench_quality_measure RESULT SOURCE [--weld T]         the figures of RESULT against SOURCE
///     bench_quality_measure --convert SOURCE OUT [--weld T]  SOURCE as vsplit reads it, for programs that do not weld; repaired
///                                                            (FULL) where it is no manifold, so that all may start from it

#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "quality/measure.h"
#include "vsplit/io/read_mesh.h"
#include "vsplit/io/write_mesh.h"
#include "vsplit/mesh/inspect.h"
#include "vsplit/repair/repair_mesh.h"

namespace {

int fail(const std::string& message) {
    std::fprintf(stderr, "%s\n", message.c_str());
    return 1;
}

std::string json(const std::optional<double>& value) { return value ? std::to_string(*value) : "null"; }

/// Whether a repair was needed, or why none helps.
vsplit::Expected<bool> make_manifold(vsplit::TriangleMesh& mesh) {
    if (vsplit::require_manifold(vsplit::inspect(mesh))) return false;
    auto repaired = vsplit::repair_mesh(mesh, {.mode = vsplit::RepairMode::kFull});
    if (!repaired) return repaired.error();
    if (vsplit::Status manifold = vsplit::require_manifold(vsplit::inspect(repaired->mesh)); !manifold) return manifold.error();
    mesh = std::move(repaired->mesh);
    return true;
}

int convert(const std::string& from, const std::string& to, double weld) {
    auto source = vsplit::read_mesh_file(from, {.weld = weld});
    if (!source) return fail(from + ": " + source.error().message);
    const vsplit::Expected<bool> repaired = make_manifold(source->mesh);
    if (!repaired) return fail(from + ": " + repaired.error().message);
    const auto format = vsplit::format_by_extension(to);
    if (!format) return fail(format.error().message);
    const vsplit::Status written = vsplit::write_mesh_file(source->mesh, *format, to);
    if (!written) return fail(written.error().message);
    std::printf("{\"faces\": %u, \"repaired\": %s}\n", source->mesh.face_count(), *repaired ? "true" : "false");
    return 0;
}

int measure(const std::string& result_path, const std::string& source_path, double weld) {
    const auto result = vsplit::read_mesh_file(result_path, {});
    if (!result) return fail(result_path + ": " + result.error().message);
    const auto source = vsplit::read_mesh_file(source_path, {.weld = weld});
    if (!source) return fail(source_path + ": " + source.error().message);
    const vsplit::bench::Figures f = vsplit::bench::measure(result->mesh, source->mesh);
    std::printf("{\"faces\": %u, \"min\": %.6g, \"p01\": %.6g, \"mean\": %.6g, \"below_02_percent\": %.6g, \"valence_max\": %u, ",
                f.quality.faces, f.quality.stretch_min, f.quality.stretch_p01, f.quality.stretch_mean,
                100.0 * f.quality.faces_below_02 / f.quality.faces, f.quality.valence_max);
    std::printf("\"deviation_percent\": %.6g, \"crease_lost_percent\": %s, \"crease_gone_percent\": %s, \"folds\": %zu, ",
                f.deviation, json(f.crease_lost).c_str(), json(f.crease_gone).c_str(), f.folds);
    std::printf("\"self_intersections\": %zu, \"source_self_intersections\": %zu, \"border_edges\": %zu}\n", f.self_intersections,
                f.source_self_intersections, f.border_edges);
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    std::vector<std::string> words(argv + 1, argv + argc);
    double weld = 0;
    if (words.size() >= 2 && words[words.size() - 2] == "--weld") {
        weld = std::strtod(words.back().c_str(), nullptr);
        words.resize(words.size() - 2);
    }
    if (words.size() == 3 && words[0] == "--convert") return convert(words[1], words[2], weld);
    if (words.size() == 2) return measure(words[0], words[1], weld);
    return fail(
        "usage: bench_quality_measure RESULT SOURCE [--weld T]\n"
        "       bench_quality_measure --convert SOURCE OUT [--weld T]");
}

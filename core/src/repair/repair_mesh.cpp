#include "vsplit/repair/repair_mesh.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "base/number_text.h"
#include "mesh/drop_unused.h"
#include "mesh/merge_vertices.h"
#include "mesh/weld_findings.h"
#include "repair/steps.h"
#include "vsplit/mesh/inspect.h"
#include "vsplit/mesh/weld.h"
#include "vsplit/quality/self_intersections.h"

namespace vsplit {
namespace {

constexpr double kStitchShare = 2e-3;
constexpr double kHoleShare = 0.05;
constexpr double kSpeckShare = 1e-3;

Status check_length(const std::optional<double>& length, const char* field) {
    if (!length || (*length >= 0 && std::isfinite(*length))) return Done{};
    return Error{Cause::kInvalidOption,
                 std::string(field) + " is " + number_text(*length) + "; a finite length of 0 or more is accepted", field};
}

/// Numbers vertices anew so that near ones are one; faces keep their place.
void weld_vertices(Draft& draft, double tolerance) {
    const std::vector<Vec3> before = draft.mesh.positions;
    const std::vector<std::uint32_t> numbers = merge_vertices(draft.mesh.positions, tolerance);
    std::vector<bool> seen(draft.mesh.positions.size(), false);
    for (std::size_t v = 0; v < before.size(); ++v) {
        if (seen[numbers[v]]) draft.changes.add(Finding::Kind::kMergedVertex, before[v]);
        seen[numbers[v]] = true;
    }
    for (Triangle& face : draft.mesh.faces) {
        for (std::uint32_t& vertex : face) vertex = numbers[vertex];
    }
}

void make_manifold(Draft& draft) {
    orient_faces(draft);
    split_non_manifold(draft);
}

/// Faces without area go, and what that tears at borders is cut apart.
void flatten(Draft& draft) {
    remove_degenerate(draft);
    make_manifold(draft);
}

/// The steps in the order that the header tells.
void repair(Draft& draft, const RepairOptions& options, const ExecutionContext& context) {
    const double diagonal = bounding_box(draft.mesh).diagonal();
    const bool full = options.mode == RepairMode::kFull;
    weld_vertices(draft, options.weld);
    if (context.cancelled()) return;
    draft.drop_collapsed();
    drop_duplicates(draft);
    const double stitch = options.stitch.value_or(kStitchShare * diagonal);
    if (full && stitch > 0) {
        stitch_borders(draft, stitch, context);
        draft.drop_collapsed();
        drop_duplicates(draft);
    }
    if (context.cancelled()) return;
    drop_hanging_needles(draft);
    make_manifold(draft);
    if (context.cancelled()) return;
    flatten(draft);
    if (context.cancelled()) return;
    if (full) {
        drop_specks(draft, options.speck_size.value_or(kSpeckShare * diagonal));
        fill_holes(draft, options.hole_size.value_or(kHoleShare * diagonal), context);
        if (context.cancelled()) return;
        flatten(draft);  // a hole whose border runs along a line is filled without area
        face_outward(draft);
    }
}

/// Pairs of faces that pass through each other.
void report_intersections(const TriangleMesh& mesh, std::vector<Finding>& findings, const ExecutionContext& context) {
    const auto pairs = find_self_intersections(mesh, context);
    if (!pairs) {
        findings.push_back({Finding::Kind::kSelfIntersection, 0, pairs.error().message, {}, {}});
        return;
    }
    if (pairs->empty()) return;
    Finding finding{Finding::Kind::kSelfIntersection, static_cast<std::uint32_t>(pairs->size()), {}, {}, {}};
    for (std::size_t i = 0; i < std::min(pairs->size(), Finding::kExamples); ++i) {
        const auto [first, second] = (*pairs)[i];
        const Triangle& t = mesh.faces[first];
        finding.elements.insert(finding.elements.end(), {first, second});
        finding.places.push_back((mesh.positions[t[0]] + mesh.positions[t[1]] + mesh.positions[t[2]]) / 3);
    }
    finding.message = std::to_string(finding.count) + " pairs of faces pass through each other; first are faces " +
                      std::to_string(finding.elements[0]) + " and " + std::to_string(finding.elements[1]);
    findings.push_back(std::move(finding));
}

}  // namespace

Status check_options(const RepairOptions& options) {
    if (Status s = check_length(options.weld, "weld"); !s) return s;
    for (const auto& [length, field] : {std::pair(options.stitch, "stitch"), std::pair(options.hole_size, "hole_size"),
                                        std::pair(options.speck_size, "speck_size")}) {
        if (Status s = check_length(length, field); !s) return s;
        if (length && options.mode != RepairMode::kFull)
            return Error{Cause::kInvalidOption, std::string(field) + " is given; it is accepted with the repair FULL alone",
                         field};
    }
    return Done{};
}

Expected<RepairedMesh> repair_mesh(const TriangleMesh& mesh, const RepairOptions& options, const ExecutionContext& context) {
    if (Status valid = check_options(options); !valid) return valid.error();
    Draft draft(mesh);
    if (options.mode != RepairMode::kNone) {
        repair(draft, options, context);
        if (context.cancelled()) return ExecutionContext::cancelled_error();
        report_emptied_groups(draft, mesh);
        static_cast<void>(drop_unused(draft.mesh));  // of faces there are none to drop
    }
    RepairedMesh repaired{std::move(draft.mesh), std::move(draft.parent), draft.changes.take()};
    const MeshReport left = inspect(repaired.mesh);
    repaired.findings.insert(repaired.findings.end(), left.findings.begin(), left.findings.end());
    report_intersections(repaired.mesh, repaired.findings, context);
    if (context.cancelled()) return ExecutionContext::cancelled_error();
    return repaired;
}

Expected<MeshReport> inspect_source(TriangleMesh& mesh, const WeldCounts& weld, const std::optional<RepairOptions>& repair,
                                    const ExecutionContext& context) {
    if (!repair) return inspect(mesh, weld);
    Expected<RepairedMesh> repaired = repair_mesh(mesh, *repair, context);
    if (!repaired) return repaired.error();
    mesh = std::move(repaired->mesh);
    MeshReport report = inspect(mesh);
    report.findings = weld_findings(weld);
    report.findings.insert(report.findings.end(), repaired->findings.begin(), repaired->findings.end());
    return report;
}

}  // namespace vsplit

#include "cli/local_run.h"

#include <functional>
#include <optional>
#include <string>
#include <utility>

#include "cli/file_hash.h"
#include "cli/input_check.h"
#include "cli/message.h"
#include "vsplit/base/execution_context.h"
#include "vsplit/io/read_mesh.h"
#include "vsplit/mesh/inspect.h"
#include "vsplit/method/control.h"
#include "vsplit/method/improve.h"
#include "vsplit/mrr/mrr_file.h"
#include "vsplit/mrr/progressive_mesh.h"
#include "vsplit/repair/repair_mesh.h"
#include "wire/convert.h"
#include "wire/features.h"
#include "wire/json.h"
#include "wire/representation.h"

namespace vsplit::cli {
namespace {

using StopCallback = std::stop_callback<std::function<void()>>;

Error one_resolution(const char* field) {
    return {Cause::kInvalidOption, "a mesh has one resolution; accepted with a .vsplit file only", field};
}

Status check_arguments(const Arguments& a) {
    if (!a.session.empty() || !a.representation.empty() || a.keep) {
        return Error{Cause::kInvalidOption, "--session, --representation and --keep need --server", "server"};
    }
    if (a.input.empty() || a.input == "-") return Error{Cause::kInvalidOption, "a file is needed to work on", "input"};
    if (Status applies = check_reading(a); !applies) return applies;
    if (a.source_faces && !is_representation_file(a.input)) return one_resolution("source_faces");
    if (!a.against.empty() && a.faces && !is_representation_file(a.input)) return one_resolution("faces");
    return Done{};
}

/// A mesh file as it was asked to be welded and repaired.
struct Source {
    TriangleMesh mesh;
    MeshReport report;
};

Expected<Source> read_source(const std::string& path, const Arguments& a) {
    Expected<ReadResult> read = read_mesh_file(path, {.weld = a.weld, .unit = a.unit});
    if (!read) return in_file(read.error(), path);
    const Expected<std::optional<RepairMode>> mode = wire::from_proto(a.repair);
    if (!mode) return mode.error();
    std::optional<RepairOptions> repair;
    if (*mode) repair = {.mode = **mode, .stitch = a.stitch, .hole_size = a.hole_size, .speck_size = a.speck_size};
    Expected<MeshReport> report = inspect_source(read->mesh, read->weld, repair);
    if (!report) return report.error();
    report->unit = read->unit;
    return Source{std::move(read->mesh), *std::move(report)};
}

struct Measured {
    TriangleMesh mesh;
    std::optional<LengthUnit> unit;
    std::vector<Finding> findings{};        ///< of a mesh as it was read and repaired
    std::optional<TriangleMesh> surface{};  ///< of a .vsplit file its finest resolution, where mid-side nodes are to go on it
};

/// A mesh, or a .vsplit file at a resolution.
Expected<Measured> read_any(const std::string& path, std::optional<std::uint32_t> faces, const Arguments& a) {
    if (is_representation_file(path)) {
        Expected<Outcome> stored = load_representation(path, faces, a.unit);
        if (!stored) return stored.error();
        Measured measured{*std::move(stored->mesh), unit_of(stored->document)};
        if (a.order == 2) measured.surface = mesh_at(stored->stored->mrr, stored->stored->mrr.levels());
        return measured;
    }
    Expected<Source> read = read_source(path, a);
    if (!read) return read.error();
    return Measured{std::move(read->mesh), read->report.unit, std::move(read->report.findings)};
}

using MethodFunction = std::function<Expected<MethodResult>(const TriangleMesh&, const MethodLimits&, const ExecutionContext&)>;

template <class Options>
Expected<Outcome> run_method(const Arguments& a, const std::vector<Output>& outputs, const Options& options,
                             const MethodFunction& method, ProgressBar& progress, const std::stop_token& stop) {
    if (Status valid = check_options(options); !valid) return valid.error();
    Expected<Measured> source = read_any(a.input, a.source_faces, a);
    if (!source) return source.error();
    if (Status writable = check_units(outputs, source->unit, a); !writable) return writable.error();
    ExecutionContext context([&](const Progress& p) { progress.show(p.stage, p.fraction, p.faces); }, a.threads);
    const StopCallback on_stop(stop, [&context] { context.cancel(); });
    const MethodLimits limits;
    Expected<MethodResult> result = method(source->mesh, limits, context);
    if (!result) return result.error();
    result->unit = source->unit;
    v1::Representation made = wire::describe("", "", source->mesh.face_count(), *result, extent_of(result->mrr));
    for (const Finding& finding : source->findings) *made.add_source_findings() = wire::to_proto(finding);
    TriangleMesh mesh = mesh_at(result->mrr, result->mrr.level_for(result->faces));
    StoredMrr stored{std::move(result->mrr), 0, ""};
    if (wants_representation(outputs)) {
        const Expected<SourceHash> hash = hash_of_file(a.input);
        if (!hash) return hash.error();
        stored.source = *hash;
    }
    TriangleMesh& surface = source->surface ? *source->surface : source->mesh;
    return Outcome{std::move(made), std::move(mesh), std::move(stored), std::move(surface)};
}

Expected<Outcome> run_improve(const Arguments& a, const std::vector<Output>& outputs, ProgressBar& progress,
                              const std::stop_token& stop) {
    const MethodFunction method = [&](const TriangleMesh& mesh, const MethodLimits& limits, const ExecutionContext& context) {
        return improve(mesh, a.improve, limits, context);
    };
    return run_method(a, outputs, a.improve, method, progress, stop);
}

Expected<Outcome> run_control(const Arguments& a, const std::vector<Output>& outputs, ProgressBar& progress,
                              const std::stop_token& stop) {
    const MethodFunction method = [&](const TriangleMesh& mesh, const MethodLimits& limits, const ExecutionContext& context) {
        return control(mesh, a.control, limits, context);
    };
    return run_method(a, outputs, a.control, method, progress, stop);
}

void add_worst_faces(const TriangleMesh& mesh, v1::QualityProfile asked, v1::Quality& quality) {
    quality = wire::to_proto(measure_quality(mesh), worst_faces(mesh, kWorstFaces));
    const Expected<std::optional<QualityProfile>> profile = wire::from_proto(asked);
    if (profile && *profile) *quality.mutable_profile() = wire::to_proto(check_profile(mesh, **profile, kWorstFaces));
}

Expected<Outcome> describe_mesh(const Arguments& a) {
    if (a.faces) return one_resolution("faces");
    Expected<Source> read = read_source(a.input, a);
    if (!read) return read.error();
    v1::MeshSummary summary = wire::to_proto(read->report);
    if (a.verb == Verb::kQuality) add_worst_faces(read->mesh, a.profile, *summary.mutable_quality());
    return Outcome{std::move(summary), std::move(read->mesh), {}};
}

/// Brings `against` to the unit of `mesh`; of which one says nothing is taken to be in that of the other. Returns what to say of
/// that.
std::string agree_on_unit(Measured& mesh, Measured& against, const Arguments& a) {
    if (mesh.unit && against.unit) convert_lengths(against.mesh.positions, *against.unit, *mesh.unit);
    if (mesh.unit.has_value() == against.unit.has_value()) return {};
    if (mesh.unit) return assumed_unit_note(a.against, a.input, *mesh.unit);
    mesh.unit = against.unit;
    return assumed_unit_note(a.input, a.against, *mesh.unit);
}

Expected<Outcome> compare_meshes(const Arguments& a, ProgressBar& progress, const std::stop_token& stop) {
    Expected<Measured> mesh = read_any(a.input, a.faces, a);
    if (!mesh) return mesh.error();
    Arguments other = a;
    other.unit.reset();  // what is stated is stated of IN
    Expected<Measured> against = read_any(a.against, {}, other);
    if (!against) return against.error();
    std::string note = agree_on_unit(*mesh, *against, a);
    ExecutionContext context([&](const Progress& p) { progress.show(p.stage, p.fraction, p.faces); }, a.threads);
    const StopCallback on_stop(stop, [&context] { context.cancel(); });
    Expected<Comparison> comparison = compare(mesh->mesh, against->mesh, a.error, context);
    if (!comparison) return comparison.error();
    comparison->unit = mesh->unit;
    return Outcome{*comparison, std::move(mesh->mesh), {}, {}, std::move(note)};
}

Expected<Outcome> find_features(const Arguments& a) {
    Expected<Measured> mesh = read_any(a.input, {}, a);
    if (!mesh) return mesh.error();
    const Expected<std::vector<ShapeFeature>> features = list_features(mesh->mesh, a.removal.search);
    if (!features) return features.error();
    return Outcome{wire::to_proto(*features, mesh->unit), std::move(mesh->mesh), {}};
}

Expected<Outcome> take_features(const Arguments& a, ProgressBar& progress, const std::stop_token& stop) {
    const Expected<Measured> mesh = read_any(a.input, {}, a);
    if (!mesh) return mesh.error();
    ExecutionContext context([&](const Progress& p) { progress.show(p.stage, p.fraction, p.faces); }, a.threads);
    const StopCallback on_stop(stop, [&context] { context.cancel(); });
    Expected<FeaturelessMesh> made = remove_features(mesh->mesh, a.removal, context);
    if (!made) return made.error();
    MeshReport report = inspect(made->mesh);
    report.unit = mesh->unit;
    std::string note;
    if (made->removed.empty() && made->kept.empty()) {
        const Expected<std::vector<ShapeFeature>> features = list_features(mesh->mesh, a.removal.search);
        if (!features) return features.error();
        note = nothing_removed_note(a.removal, wire::to_proto(*features, mesh->unit));
    }
    return Outcome{wire::to_proto(*made, report), std::move(made->mesh), {}, {}, std::move(note)};
}

Expected<Outcome> describe_representation(const Arguments& a) {
    Expected<Outcome> outcome = load_representation(a.input, a.faces, a.unit);
    if (!outcome || a.verb != Verb::kQuality) return outcome;
    add_worst_faces(*outcome->mesh, a.profile, *std::get<v1::Representation>(outcome->document).mutable_quality());
    return outcome;
}

/// What is known of a representation that was stored without a description, or with one that cannot be read.
v1::Representation description_of(const StoredMrr& stored) {
    v1::Representation representation;
    const Status read = wire::from_json(stored.description, representation, wire::UnknownFields::kIgnored);
    if (!read) representation.Clear();
    const MrrExtent extent = extent_of(stored.mrr);
    representation.set_faces_min(extent.faces_min);
    representation.set_faces_max(extent.faces_max);
    *representation.mutable_records() = wire::count_records(extent);
    return representation;
}

}  // namespace

Expected<Outcome> load_representation(const std::string& path, std::optional<std::uint32_t> faces,
                                      std::optional<LengthUnit> unit) {
    Expected<StoredMrr> stored = load_mrr(path);
    if (!stored) return in_file(stored.error(), path);
    v1::Representation representation = description_of(*stored);
    const Expected<std::optional<LengthUnit>> agreed = agreed_unit(unit_of(representation), unit);
    if (!agreed) return agreed.error();
    representation.set_unit(wire::to_proto(*agreed));
    TriangleMesh mesh = mesh_at(stored->mrr, stored->mrr.level_for(faces.value_or(stored->faces)));
    wire::describe_resolution(mesh, representation);
    return Outcome{std::move(representation), std::move(mesh), *std::move(stored)};
}

Expected<Outcome> run_locally(const Arguments& a, const std::vector<Output>& outputs, ProgressBar& progress,
                              const std::stop_token& stop) {
    if (Status valid = check_arguments(a); !valid) return valid.error();
    if (a.verb == Verb::kImprove) return run_improve(a, outputs, progress, stop);
    if (a.verb == Verb::kControl) return run_control(a, outputs, progress, stop);
    if (a.verb == Verb::kFeatures) return find_features(a);
    if (a.verb == Verb::kRemoveFeatures) return take_features(a, progress, stop);
    if (!a.against.empty()) return compare_meshes(a, progress, stop);
    if (is_representation_file(a.input)) return describe_representation(a);
    if (a.verb != Verb::kResolution) return describe_mesh(a);
    return Error{Cause::kInvalidOption, "'" + a.input + "' is no .vsplit file; make one with `vsplit improve MESH -o x.vsplit`",
                 "input"};
}

}  // namespace vsplit::cli

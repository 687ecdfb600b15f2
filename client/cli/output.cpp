#include "cli/output.h"

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <system_error>

#include "cli/message.h"
#include "vsplit/base/execution_context.h"
#include "vsplit/io/second_order.h"
#include "vsplit/io/write_mesh.h"
#include "vsplit/mrr/mrr_file.h"
#include "vsplit/mrr/progressive_mesh.h"
#include "wire/convert.h"
#include "wire/enum_value.h"
#include "wire/json.h"

namespace vsplit::cli {
namespace {

constexpr const char* kRepresentationFormat = "vsplit";

/// A computation of an hour must not end at a directory that was misspelt.
Status check_place(const std::string& path) {
    if (path == "-") {
        return Error{Cause::kInvalidOption,
                     "'-' is no file, and the standard output is for the report; accepted is a name, ./- too", "output"};
    }
    std::error_code ignored;
    const std::filesystem::path parent = std::filesystem::path(path).parent_path();
    if (!parent.empty() && !std::filesystem::is_directory(parent, ignored)) {
        return Error{Cause::kNotFound, "cannot write '" + path + "': there is no directory '" + parent.string() + "'", "output"};
    }
    if (std::filesystem::is_directory(path, ignored)) {
        return Error{Cause::kFileAccess, "cannot write '" + path + "': it is a directory", "output"};
    }
    return Done{};
}

/// By any name that a server takes too.
Expected<MeshFormat> format_called(const std::string& name) {
    const auto* const value = wire::find_value(*v1::MeshFormat_descriptor(), name);
    if (value == nullptr || value->number() == v1::MESH_FORMAT_UNSPECIFIED) return format_by_name(name);
    const Expected<std::optional<MeshFormat>> format = wire::from_proto(static_cast<v1::MeshFormat>(value->number()));
    if (!format) return format.error();
    return **format;
}

Expected<Output> plan_output(const std::string& path, const std::string& format_name) {
    if (wire::folded(format_name) == kRepresentationFormat) return Output{path, {}};
    if (format_name.empty() && is_representation_file(path)) return Output{path, {}};
    Expected<MeshFormat> format = format_name.empty() ? format_by_extension(path) : format_called(format_name);
    if (format) return Output{path, *format};
    Error error = format.error();
    error.message += "; a whole representation is written to .vsplit";
    error.field = format_name.empty() ? "output" : "format";
    return error;
}

Expected<MidsideNodes> nodes_of(const Outcome& outcome) {
    const ExecutionContext context;
    if (outcome.surface) return midside_nodes(*outcome.mesh, *outcome.surface, context);
    if (!outcome.stored) return midside_nodes(*outcome.mesh, *outcome.mesh, context);
    const MultiresMesh& mrr = outcome.stored->mrr;
    return midside_nodes(*outcome.mesh, mesh_at(mrr, mrr.levels()), context);
}

/// Whether a .vsplit file alone knows no more than the mesh that `control` was given.
std::string surface_note(const Document& document) {
    const auto* made = std::get_if<v1::Representation>(&document);
    return made != nullptr ? controlled_surface_note(*made) : "";
}

/// The outcome's mesh in the unit of the outputs.
Status write_mesh_output(const Outcome& outcome, const Output& output, const Arguments& arguments) {
    const std::optional<LengthUnit> from = unit_of(outcome.document);
    if (Status possible = check_unit(*output.format, from, arguments.output_unit); !possible) return possible;
    const std::optional<LengthUnit> to = arguments.output_unit ? arguments.output_unit : from;
    std::optional<TriangleMesh> converted;
    if (from != to) convert_lengths(converted.emplace(*outcome.mesh).positions, *from, *to);
    const TriangleMesh& mesh = converted ? *converted : *outcome.mesh;
    std::cerr << losses_note(mesh, *output.format, output.path);
    if (arguments.order != 2) return write_mesh_file(mesh, *output.format, output.path, to);
    Expected<MidsideNodes> nodes = nodes_of(outcome);
    if (!nodes) return nodes.error();
    if (from != to) convert_lengths(nodes->positions, *from, *to);
    if (!outcome.surface) std::cerr << surface_note(outcome.document);
    std::cerr << on_chord_note(nodes->on_chord);
    return write_second_order_file(mesh, *nodes, *output.format, output.path);
}

/// What was measured of the resolution that is described, where the file does not say it yet.
void note_deviation(const v1::Representation& description, StoredMrr& stored) {
    if (!description.quality().has_deviation_max()) return;
    const auto level = static_cast<std::uint32_t>(stored.mrr.level_for(description.faces()));
    const auto at = std::lower_bound(stored.deviations.begin(), stored.deviations.end(), level,
                                     [](const LevelDeviation& known, std::uint32_t sought) { return known.level < sought; });
    if (at != stored.deviations.end() && at->level == level) return;
    stored.deviations.insert(at, {level, description.quality().deviation_max()});
}

Status write_representation(const Outcome& outcome, const Output& output, const Arguments& arguments) {
    const auto* made = std::get_if<v1::Representation>(&outcome.document);
    if (made == nullptr || !outcome.stored) {
        return Error{Cause::kInvalidOption,
                     "'" + output.path +
                         "' would hold a representation, and there is only a mesh; accepted are .stl, "
                         ".obj, .ply, .off, .msh, .inp, .bdf, .vtk, .vtu and .3mf, or `improve` or `control` the mesh first",
                     "output"};
    }
    // The same input and options give the same file: it holds nothing of the run that made it.
    v1::Representation description = *made;
    description.clear_id();
    description.clear_elapsed();
    description.clear_source_findings();
    description.clear_groups();  // who reads it has the mesh
    description.clear_group_count();
    StoredMrr stored = *outcome.stored;
    stored.faces = description.faces();
    stored.description = wire::to_json(description);
    stored.unit = unit_of(outcome.document);
    note_deviation(description, stored);
    if (!arguments.encoding) return save_mrr(stored, output.path);
    const Expected<StoredMrr> encoded = in_encoding(std::move(stored), *arguments.encoding);
    if (!encoded) return encoded.error();
    return save_mrr(*encoded, output.path);
}

}  // namespace

Expected<std::vector<Output>> plan_outputs(const Arguments& arguments) {
    std::vector<Output> outputs;
    for (const std::string& path : arguments.outputs) {
        if (Status possible = check_place(path); !possible) return possible.error();
        Expected<Output> output = plan_output(path, arguments.format);
        if (!output) return output.error();
        if (arguments.order == 2 && output->format && !has_second_order(*output->format)) {
            return write_second_order({}, {}, *output->format).error();
        }
        outputs.push_back(*std::move(output));
    }
    if (arguments.encoding && !wants_representation(outputs)) {
        return Error{Cause::kInvalidOption, "--encoding is that of .vsplit files, and none is written; accepted with -o x.vsplit",
                     "encoding"};
    }
    return outputs;
}

bool wants_representation(const std::vector<Output>& outputs) {
    return std::any_of(outputs.begin(), outputs.end(), [](const Output& output) { return !output.format; });
}

Status check_units(const std::vector<Output>& outputs, std::optional<LengthUnit> unit, const Arguments& arguments) {
    for (const Output& output : outputs) {
        if (!output.format) continue;
        if (Status possible = check_unit(*output.format, unit, arguments.output_unit); !possible) return possible;
    }
    return Done{};
}

Status write_outputs(const Outcome& outcome, const std::vector<Output>& outputs, const Arguments& arguments) {
    for (const Output& output : outputs) {
        if (output.format && !outcome.mesh) continue;  // the server sent the file
        Status written =
            output.format ? write_mesh_output(outcome, output, arguments) : write_representation(outcome, output, arguments);
        if (!written) return written;
    }
    return Done{};
}

}  // namespace vsplit::cli

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/arguments.h"
#include "cli/outcome.h"
#include "vsplit/base/expected.h"
#include "vsplit/io/mesh_format.h"

namespace vsplit::cli {

/// A file to write: a mesh, or, without a format, the whole representation.
struct Output {
    std::string path;
    std::optional<MeshFormat> format;
};

/// The files asked for, before anything is computed. \return UNKNOWN_FORMAT or INVALID_OPTION for a file that cannot be told how
/// to write.
[[nodiscard]] Expected<std::vector<Output>> plan_outputs(const Arguments& arguments);

/// Whether any of them is a representation.
[[nodiscard]] bool wants_representation(const std::vector<Output>& outputs);

/// Writes what was not downloaded. \return INVALID_OPTION for a representation where there is but a mesh; FILE_ACCESS.
/// Of order 2 stderr tells how many sides stay straight where some do.
/// Mesh files are converted to `arguments.output_unit`.
[[nodiscard]] Status write_outputs(const Outcome& outcome, const std::vector<Output>& outputs, const Arguments& arguments);

/// Whether a mesh in `unit` can be written to all of them, to be asked before anything is computed. \return what check_unit
/// returns.
[[nodiscard]] Status check_units(const std::vector<Output>& outputs, std::optional<LengthUnit> unit, const Arguments& arguments);

}  // namespace vsplit::cli

#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "vsplit/base/error.h"
#include "vsplit/io/mesh_format.h"
#include "vsplit/mesh/length_unit.h"
#include "vsplit/mesh/triangle_mesh.h"
#include "vsplit/shapes/remove_features.h"
#include "vsplit/v1/meshing.pb.h"

namespace vsplit::cli {

/// What stderr says of a failure: one line, with the option at fault where a field is named, or options that help.
[[nodiscard]] std::string error_message(const Error& error);

/// A line for each bound that is broken: which, how often, the worst, why. Empty when all hold.
[[nodiscard]] std::string violation_messages(const v1::Representation& made);

/// `text` for a terminal: bytes that are no UTF-8 and control characters, which a file may hold, are question marks.
[[nodiscard]] std::string printable(std::string_view text);

/// What stands behind a length: " mm"; empty where the unit is not known.
[[nodiscard]] std::string unit_suffix(std::optional<LengthUnit> unit);

/// A figure of what a bound bounds, with `unit`, a suffix, behind it where that is a length.
[[nodiscard]] std::string figure_of_bound(const v1::Violation& violation, double value, const std::string& unit);

/// How many faces or vertices break a bound, e.g. "12 faces".
[[nodiscard]] std::string broken_by(const v1::Violation& violation);

/// A line that says which resolution was taken where the one asked for does not exist; empty where it does (counts go in steps of
/// two faces).
[[nodiscard]] std::string nearest_note(std::uint32_t asked, const v1::Representation& made);

/// A line for each finding of what a method worked on, repairs too. Empty where there is none.
[[nodiscard]] std::string finding_messages(const v1::Representation& made);

/// A line that says that a mesh's lengths were taken to be in the unit of another.
[[nodiscard]] std::string assumed_unit_note(const std::string& path, const std::string& other, LengthUnit unit);

/// A line that says that no feature is as small as asked for, and which are larger; empty where no diameter was asked for.
[[nodiscard]] std::string nothing_removed_note(const FeatureRemoval& removal, const v1::ListFeaturesResponse& features);

/// A line that says how many sides of second-order elements are straight so that none is bad; empty for none.
[[nodiscard]] std::string on_chord_note(std::uint32_t edges);

/// Lines that say what a file of `format` does not hold of the mesh: sets, and coordinates as fine as its edges.
[[nodiscard]] std::string losses_note(const TriangleMesh& mesh, MeshFormat format, const std::string& path);

/// A line that says that mid-side nodes of a stored representation lie on what `control` was given; empty for one of `improve`,
/// whose finest resolution is the source's surface.
[[nodiscard]] std::string controlled_surface_note(const v1::Representation& made);

/// Where a server puts middle nodes of what it makes of a .vsplit file; empty for other files.
[[nodiscard]] std::string sent_surface_note(const std::string& input);

}  // namespace vsplit::cli

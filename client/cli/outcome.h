#pragma once

#include <optional>
#include <string>
#include <variant>

#include "cli/comparison.h"
#include "vsplit/mesh/length_unit.h"
#include "vsplit/mesh/triangle_mesh.h"
#include "vsplit/mrr/mrr_file.h"
#include "vsplit/v1/meshing.pb.h"

namespace vsplit::cli {

/// What `--json` prints and what the report tells.
using Document =
    std::variant<v1::MeshSummary, v1::Representation, Comparison, v1::ListFeaturesResponse, v1::RemoveFeaturesResponse>;

/// The unit of the lengths that a document tells; empty where it is not known.
[[nodiscard]] std::optional<LengthUnit> unit_of(const Document& document);

/// What a verb came to.
struct Outcome {
    Document document;
    std::optional<TriangleMesh> mesh;       ///< what mesh files are written from; empty where they were downloaded as files
    std::optional<StoredMrr> stored;        ///< what a .vsplit file is written from; what the document tells is added
    std::optional<TriangleMesh> surface{};  ///< what was worked on, where it is there: mid-side nodes are put on it
    std::string note{};                     ///< for stderr, a whole line: what was assumed, or why nothing was done
};

}  // namespace vsplit::cli

#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "vsplit/base/execution_context.h"
#include "vsplit/base/expected.h"
#include "vsplit/mesh/length_unit.h"
#include "vsplit/quality/crease_deviation.h"
#include "vsplit/quality/deviation.h"

namespace vsplit::cli {

/// How far two meshes are apart.
struct Comparison {
    std::uint32_t faces = 0;
    std::uint32_t faces_against = 0;
    double diagonal = 0;               ///< of the other mesh's bounding box
    std::optional<LengthUnit> unit{};  ///< of all lengths
    Deviation surface;
    CreaseDeviation creases;
};

/// `against` is the source; bounds of distances are within `error` of each other (length > 0), or as close as by default.
/// \return INVALID_OPTION (error) and what the measures return.
[[nodiscard]] Expected<Comparison> compare(const TriangleMesh& mesh, const TriangleMesh& against, std::optional<double> error,
                                           const ExecutionContext& context);

/// One document, its lengths in `unit`; a distance to creases that are not there is null.
[[nodiscard]] std::string to_json(const Comparison& comparison);

}  // namespace vsplit::cli

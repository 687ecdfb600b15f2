#pragma once

#include <cstdint>
#include <string>

#include "vsplit/base/execution_context.h"
#include "vsplit/base/expected.h"
#include "vsplit/quality/crease_deviation.h"
#include "vsplit/quality/deviation.h"

namespace vsplit::cli {

/// How far two meshes are apart.
struct Comparison {
    std::uint32_t faces = 0;
    std::uint32_t faces_against = 0;
    double diagonal = 0;  ///< of the other mesh's bounding box
    Deviation surface;
    CreaseDeviation creases;
};

/// Measures with the default accuracy; `against` is the source. \return what the measures return.
[[nodiscard]] Expected<Comparison> compare(const TriangleMesh& mesh, const TriangleMesh& against,
                                           const ExecutionContext& context);

/// One document, lengths in the units of the mesh; a distance to creases that are not there is null.
[[nodiscard]] std::string to_json(const Comparison& comparison);

}  // namespace vsplit::cli

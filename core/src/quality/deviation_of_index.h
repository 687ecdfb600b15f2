#pragma once

#include "quality/deviation_search.h"
#include "spatial/surface_index.h"
#include "vsplit/quality/deviation.h"

namespace vsplit {

/// A mesh with its index at hand, to measure many results against one source. Both must outlive the calls.
struct IndexedMesh {
    const TriangleMesh& mesh;
    const SurfaceIndex& index;  ///< of that mesh, or of another with the same surface
};

/// measure_deviation for who has the indices; the same answer.
[[nodiscard]] Expected<Deviation> measure_deviation(const IndexedMesh& result, const IndexedMesh& source,
                                                    const DeviationOptions& options, const ExecutionContext& context);

/// One way only: how far the faces of `from` get from the surface `to` is of; `diagonal` is the source's, for the default error.
[[nodiscard]] Expected<DirectedDeviation> measure_directed_deviation(const TriangleMesh& from, const SurfaceIndex& to,
                                                                     double diagonal, const DeviationOptions& options,
                                                                     const ExecutionContext& context);

/// \return EMPTY_INPUT naming `which` mesh has no faces.
[[nodiscard]] Status require_faces(const TriangleMesh& mesh, const char* which);

/// The options with defaults filled in for `elements` faces or creases and a source of this diagonal. \return INVALID_OPTION.
[[nodiscard]] Expected<SearchLimits> search_limits(const DeviationOptions& options, double diagonal, std::uint64_t elements);

}  // namespace vsplit

#pragma once

#include "method/method_run.h"

namespace vsplit {

/// Fills in what has to do with creases of the result's shown resolution: crease_deviation_max in the extended mode, and
/// `slivers`. The source's creases are those the method used; `surface` is the source's, or null. O(faces + creases log creases).
/// \return CANCELLED.
[[nodiscard]] Status report_creases(MethodResult& result, const TriangleMesh& source, const SurfaceIndex* surface,
                                    const MethodRun& run, const ExecutionContext& context);

}  // namespace vsplit

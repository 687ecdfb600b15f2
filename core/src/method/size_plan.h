#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "vsplit/base/execution_context.h"
#include "vsplit/method/method_options.h"
#include "vsplit/method/method_result.h"
#include "vsplit/sizing/size_field.h"

namespace vsplit {

/// How large faces are to be where, for one run of a method.
struct SizePlan {
    SizeField field;
    double usual = std::numeric_limits<double>::infinity();  ///< length: what is wanted where the field allows more
    bool binding = false;  ///< no edge may be longer than the field allows; else sizes only say what is collapsed first
};

/// The plan for what the user asks for. `creases` are those of `mesh`. \return INVALID_OPTION. O(faces log faces).
[[nodiscard]] Expected<SizePlan> plan_sizes(const TriangleMesh& mesh, const SizingOptions& sizing,
                                            const std::vector<SharpEdge>& creases, double usual);

/// `sizing` for `mended`, whose first vertices are those of `mesh` and whose others lie on its surface: they are given the size
/// that its field has there, or no bound where that has none. O(faces log faces).
[[nodiscard]] SizingOptions with_field_on(const TriangleMesh& mended, const TriangleMesh& mesh, SizingOptions sizing);

/// The plan where nothing is asked for: faces get smaller than `usual` where the surface bends, so that a chord stays within half
/// of `tolerance` of it, but no more than are worth waiting for. O(faces log faces + face_budget).
[[nodiscard]] Expected<SizePlan> plan_by_curvature(const TriangleMesh& mesh, const std::vector<SharpEdge>& creases,
                                                   double tolerance, double usual, std::uint32_t face_budget,
                                                   const ExecutionContext& context);

/// Sizes allowed at the vertices of `fine`, a subdivision of `source`. O(faces log faces).
[[nodiscard]] std::vector<double> allowed_sizes(const SubdividedMesh& fine, const TriangleMesh& source, const SizePlan& plan);

/// How many faces cover `fine` when each is as large as is wanted where it lies. O(faces log faces).
[[nodiscard]] double wanted_faces(const SubdividedMesh& fine, const TriangleMesh& source, const SizePlan& plan);

/// Faces of `result` with an edge longer than the source's field allows at either of its ends, where the plan is binding; worst
/// by that ratio, limit 1. O(faces log faces).
[[nodiscard]] std::optional<Violation> find_oversized(const TriangleMesh& result, const TriangleMesh& source,
                                                      const SizePlan& plan);

}  // namespace vsplit

#pragma once

#include <cstdint>

#include "vsplit/base/expected.h"
#include "vsplit/mesh/triangle_mesh.h"

/// What subdivisions refuse, in words.
namespace vsplit {

/// Whether `max_edge` is a length and `mesh` keeps to the limit as it is. \return INVALID_OPTION, LIMIT_EXCEEDED.
[[nodiscard]] Status check_subdivision(const TriangleMesh& mesh, double max_edge, std::uint32_t face_limit);

/// Whether `mesh` keeps to the limit as it is, before sizes that vary. \return LIMIT_EXCEEDED.
[[nodiscard]] Status check_subdivision_to_sizes(const TriangleMesh& mesh, std::uint32_t face_limit);

/// LIMIT_EXCEEDED; `fitting` is a length that keeps to the limit.
[[nodiscard]] Error too_many_faces(double max_edge, std::uint32_t face_limit, double fitting);

/// The same for sizes that vary; with none under `fitting` the limit is kept.
[[nodiscard]] Error too_many_faces_of_sizes(std::uint32_t face_limit, double fitting);

/// Whether one-to-four may be done so often. \return INVALID_OPTION, LIMIT_EXCEEDED.
[[nodiscard]] Status check_times(const TriangleMesh& mesh, std::uint32_t times, std::uint32_t face_limit);

}  // namespace vsplit

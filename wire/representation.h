#pragma once

#include <string>

#include "vsplit/method/method_result.h"
#include "vsplit/mrr/mrr_extent.h"
#include "vsplit/v1/meshing.pb.h"

namespace vsplit::wire {

/// The message about what a method made.
/// `source_representation` is empty, and `source_faces` the mesh's own count, where the upload was worked on. O(1).
[[nodiscard]] v1::Representation describe(const std::string& id, const std::string& source_representation,
                                          std::uint32_t source_faces, const MethodFigures& figures, const MrrExtent& extent);

/// The message about a method that the end of a server cut off. O(size of the options).
[[nodiscard]] v1::InterruptedMethod describe_interrupted(const std::string& source_representation, std::uint32_t source_faces,
                                                         const MethodOptions& options);

/// Moves the figures of a Representation to another of its resolutions, whose mesh is given: faces, quality, and, for CONTROL,
/// what breaks its bounds there; and its groups. What the method said of a bound stays its reason; what takes the source to tell,
/// deviations and slivers, goes. O(faces log faces).
void describe_resolution(const TriangleMesh& mesh, v1::Representation& representation);

/// The two parts of it, for who has the figures already: the quality of the mesh, and after it which bounds of Control hold.
void describe_quality(const Quality& quality, v1::Representation& representation);
void describe_bounds(const TriangleMesh& mesh, v1::Representation& representation);

}  // namespace vsplit::wire

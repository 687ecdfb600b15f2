#pragma once

#include "vsplit/base/expected.h"
#include "vsplit/mesh/inspect.h"
#include "vsplit/method/method_result.h"
#include "vsplit/v1/meshing.pb.h"

/// Core's values out of the messages that describe them (wire/convert.h, wire/representation.h), as far as those tell.
namespace vsplit::wire {

[[nodiscard]] BoundingBox from_proto(const v1::BoundingBox& box);

/// Without the worst faces. \return CORRUPT for a histogram of another length.
[[nodiscard]] Expected<Quality> from_proto(const v1::Quality& quality);

/// The counts of a summary; those that it does not have are 0. \return CORRUPT for a finding of no known kind.
[[nodiscard]] Expected<MeshReport> from_proto(const v1::MeshSummary& summary);

/// What `describe` was given, without marked_edges, regions and sizing.field. \return CORRUPT, INVALID_OPTION.
[[nodiscard]] Expected<MethodFigures> figures_of(const v1::Representation& representation);

}  // namespace vsplit::wire

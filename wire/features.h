#pragma once

#include "vsplit/base/expected.h"
#include "vsplit/mesh/inspect.h"
#include "vsplit/mesh/length_unit.h"
#include "vsplit/shapes/remove_features.h"
#include "vsplit/shapes/shape_features.h"
#include "vsplit/v1/meshing.pb.h"

/// Features of shape as messages and back.
namespace vsplit::wire {

/// Of the faces the first kMostFeatureFaces.
inline constexpr std::size_t kMostFeatureFaces = 10'000;

[[nodiscard]] v1::ShapeFeature::Kind to_proto(ShapeFeature::Kind kind);
[[nodiscard]] v1::ShapeFeature to_proto(const ShapeFeature& feature);

/// Their lengths are in `unit`.
[[nodiscard]] v1::ListFeaturesResponse to_proto(const std::vector<ShapeFeature>& features, std::optional<LengthUnit> unit);

/// `report` is of the mesh without them.
[[nodiscard]] v1::RemoveFeaturesResponse to_proto(const FeaturelessMesh& made, const MeshReport& report);

/// `angle` of a request, its default filled in; ranges are for list_features.
template <class Request>
[[nodiscard]] FeatureSearch search_of(const Request& request) {
    FeatureSearch search;
    if (request.has_angle()) search.angle = request.angle();
    return search;
}

/// \return INVALID_OPTION for a kind that is none.
[[nodiscard]] Expected<FeatureRemoval> from_proto(const v1::RemoveFeaturesRequest& request);

}  // namespace vsplit::wire

#pragma once

#include <string_view>

#include "service/bounded_work.h"
#include "service/meshing_service.h"
#include "vsplit/shapes/remove_features.h"
#include "vsplit/shapes/shape_features.h"

namespace vsplit::service {

struct FeaturesFound {
    std::vector<ShapeFeature> features;
    std::optional<LengthUnit> unit;  ///< of their lengths
};

/// The features of the session's upload. Heavy: for `errand`. \return NOT_FOUND, NOT_READY, what `list_features` returns.
[[nodiscard]] Expected<FeaturesFound> list_features_of(MeshingService& service, std::string_view session,
                                                       const FeatureSearch& search, const Caller& caller = {});

struct FeaturesRemoved {
    FeaturelessMesh made;  ///< its mesh has gone into `source`
    std::shared_ptr<const SourceMesh> source;
};

/// Puts the upload without some features in its place and drops the representations; where none goes, nothing changes, and where
/// it is not `wanted` any more. Heavy: for `intake`. \return NOT_FOUND, NOT_READY, BUSY, also where the
/// mesh was replaced meanwhile; LIMIT_EXCEEDED (memory, time, faces); what `remove_features` returns.
[[nodiscard]] Expected<FeaturesRemoved> remove_features_of(MeshingService& service, std::string_view session,
                                                           const FeatureRemoval& removal, const StillWanted& wanted,
                                                           const Caller& caller = {});

}  // namespace vsplit::service

#include "wire/features.h"

#include <algorithm>
#include <string>

#include "wire/convert.h"

namespace vsplit::wire {
v1::ShapeFeature::Kind to_proto(ShapeFeature::Kind kind) {
    switch (kind) {
        case ShapeFeature::Kind::kThroughHole:
            return v1::ShapeFeature::THROUGH_HOLE;
        case ShapeFeature::Kind::kBlindHole:
            return v1::ShapeFeature::BLIND_HOLE;
        case ShapeFeature::Kind::kBoss:
            return v1::ShapeFeature::BOSS;
        case ShapeFeature::Kind::kFillet:
            return v1::ShapeFeature::FILLET;
    }
    return v1::ShapeFeature::KIND_UNSPECIFIED;
}

namespace {

Expected<ShapeFeature::Kind> kind_from(int kind) {
    switch (kind) {
        case v1::ShapeFeature::THROUGH_HOLE:
            return ShapeFeature::Kind::kThroughHole;
        case v1::ShapeFeature::BLIND_HOLE:
            return ShapeFeature::Kind::kBlindHole;
        case v1::ShapeFeature::BOSS:
            return ShapeFeature::Kind::kBoss;
        case v1::ShapeFeature::FILLET:
            return ShapeFeature::Kind::kFillet;
        default:
            return Error{Cause::kInvalidOption,
                         "a kind is " + std::to_string(kind) +
                             ", which names none; accepted are THROUGH_HOLE, BLIND_HOLE, BOSS and FILLET",
                         "kinds"};
    }
}

}  // namespace

v1::ShapeFeature to_proto(const ShapeFeature& feature) {
    v1::ShapeFeature proto;
    proto.set_id(feature.id);
    proto.set_kind(to_proto(feature.kind));
    proto.set_diameter(feature.diameter);
    proto.set_depth(feature.depth);
    *proto.mutable_axis() = to_proto(feature.axis);
    *proto.mutable_centre() = to_proto(feature.centre);
    proto.set_face_count(static_cast<std::uint32_t>(feature.faces.size()));
    const auto named = static_cast<std::ptrdiff_t>(std::min(feature.faces.size(), kMostFeatureFaces));
    proto.mutable_faces()->Assign(feature.faces.begin(), feature.faces.begin() + named);
    return proto;
}

v1::ListFeaturesResponse to_proto(const std::vector<ShapeFeature>& features, std::optional<LengthUnit> unit) {
    v1::ListFeaturesResponse proto;
    for (const ShapeFeature& feature : features) *proto.add_features() = to_proto(feature);
    proto.set_unit(to_proto(unit));
    return proto;
}

v1::RemoveFeaturesResponse to_proto(const FeaturelessMesh& made, const MeshReport& report) {
    v1::RemoveFeaturesResponse proto;
    *proto.mutable_source() = to_proto(report);
    proto.mutable_removed()->Assign(made.removed.begin(), made.removed.end());
    for (const KeptFeature& kept : made.kept) {
        v1::KeptFeature& added = *proto.add_kept();
        added.set_id(kept.id);
        added.set_reason(kept.reason);
    }
    proto.set_first_new_face(made.first_new_face);
    proto.set_size(made.size);
    return proto;
}

Expected<FeatureRemoval> from_proto(const v1::RemoveFeaturesRequest& request) {
    FeatureRemoval removal{search_of(request), {request.ids().begin(), request.ids().end()}, {}, {}};
    if (request.has_max_diameter()) removal.max_diameter = request.max_diameter();
    for (const int kind : request.kinds()) {
        const Expected<ShapeFeature::Kind> known = kind_from(kind);
        if (!known) return known.error();
        removal.kinds.push_back(*known);
    }
    return removal;
}

}  // namespace vsplit::wire

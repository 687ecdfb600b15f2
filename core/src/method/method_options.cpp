#include "vsplit/method/method_options.h"

#include <algorithm>
#include <limits>
#include <string>

#include "base/number_text.h"
#include "method/reachable_bounds.h"

namespace vsplit {
namespace {

Error invalid(const std::string& field, const std::string& was, const std::string& accepted) {
    return {Cause::kInvalidOption, field + " is " + was + "; accepted is " + accepted, field};
}

/// An interval of doubles, either end open or closed.
struct Range {
    double low = 0;
    double high = 0;
    bool low_included = true;
    const char* words = "";
    bool high_included = true;
};

constexpr Range kPositive{0, 1e300, false, "a positive finite length"};
constexpr Range kAngle{0, 180, true, "0 to 180 degrees"};
constexpr Range kWeight{0, 1e6, true, "0 to 1e6"};
constexpr Range kStretch{0, 1, true, "0 to 1"};
constexpr Range kLeastAngle{0, 60, false, "more than 0 and less than 60 degrees, since the angles of a face sum to 180", false};
constexpr Range kLargestAngle{60, 180, false, "more than 60 and less than 180 degrees, since the angles of a face sum to 180",
                              false};
constexpr Range kAspect{1, 1e300, true, "1 or more, and finite: the longest edge over the shortest"};
constexpr std::uint32_t kMaxSubdivisions = 12;
constexpr std::uint32_t kLeastValenceBound = 6;

Status check_range(const std::optional<double>& value, const Range& range, const char* field) {
    if (!value) return Done{};
    const bool inside = (range.low_included ? *value >= range.low : *value > range.low) &&
                        (range.high_included ? *value <= range.high : *value < range.high);
    return inside ? Status(Done{}) : invalid(field, number_text(*value), range.words);  // NaN is never inside
}

Status check_faces(const std::optional<std::uint32_t>& faces, const std::optional<std::uint32_t>& faces_min) {
    if (faces && *faces < kLeastFaces) return invalid("faces", std::to_string(*faces), "at least 4");
    if (faces_min && *faces_min < kLeastFaces) return invalid("faces_min", std::to_string(*faces_min), "at least 4");
    if (faces && faces_min && *faces_min > *faces) {
        return invalid("faces_min", std::to_string(*faces_min), "at most faces, which is " + std::to_string(*faces));
    }
    return Done{};
}

/// What both methods share.
template <class Options>
Status check_common(const Options& options, const std::optional<double>& max_size) {
    if (options.sizing) {
        if (Status s = check_sizing(*options.sizing, max_size); !s) return s;
    }
    if (options.max_deviation && options.mode == Mode::kStrict) {
        return Error{Cause::kUnsupported,
                     "max_deviation comes with the extended mode; in mode STRICT leave it out and bound the quadric error with "
                     "tolerance",
                     "max_deviation"};
    }
    if (Status s = check_range(options.max_deviation, kPositive, "max_deviation"); !s) return s;
    if (Status s = check_range(options.tolerance, kPositive, "tolerance"); !s) return s;
    if (Status s = check_range(options.feature_angle, kAngle, "feature_angle"); !s) return s;
    if (Status s = check_range(options.feature_weight, kWeight, "feature_weight"); !s) return s;
    return check_faces(options.faces, options.faces_min);
}

Status check_at_most(double min_size, double limit, const std::string& whose) {
    if (min_size <= limit) return Done{};
    return invalid("min_size", number_text(min_size), "at most " + whose + ", which is " + number_text(limit));
}

/// Sizes that are asked for at a place, no less than sizing.min_size, leave room for faces of min_size. `sizing` was checked.
Status check_min_size_under(double min_size, const SizingOptions& sizing) {
    const double floor = sizing.min_size.value_or(0);
    const auto name = [](const char* field, std::size_t index) { return field + ('[' + std::to_string(index) + ']'); };
    for (std::size_t i = 0; i < sizing.spheres.size(); ++i) {
        const double size = std::max(floor, sizing.spheres[i].size);
        if (Status s = check_at_most(min_size, size, "the size of " + name("sizing.spheres", i)); !s) return s;
    }
    for (std::size_t i = 0; i < sizing.boxes.size(); ++i) {
        const double size = std::max(floor, sizing.boxes[i].size);
        if (Status s = check_at_most(min_size, size, "the size of " + name("sizing.boxes", i)); !s) return s;
    }
    for (std::size_t i = 0; i < sizing.field.size(); ++i) {
        if (sizing.field[i] == 0) continue;
        if (Status s = check_at_most(min_size, std::max(floor, sizing.field[i]), name("sizing.field", i)); !s) return s;
    }
    return sizing.max_size ? check_at_most(min_size, *sizing.max_size, "sizing.max_size") : Status(Done{});
}

/// Bounds on the angles, sides and size of a face.
Status check_face_bounds(const ControlOptions& options) {
    if (Status s = check_range(options.min_angle, kLeastAngle, "min_angle"); !s) return s;
    if (Status s = check_range(options.max_angle, kLargestAngle, "max_angle"); !s) return s;
    if (Status s = check_range(options.max_aspect_ratio, kAspect, "max_aspect_ratio"); !s) return s;
    if (Status s = check_range(options.min_size, kPositive, "min_size"); !s || !options.min_size) return s;
    return options.max_size ? check_at_most(*options.min_size, *options.max_size, "max_size") : Status(Done{});
}

/// Distances are differences of coordinates, which have so many digits.
Status check_resolved(const TriangleMesh& source, const std::optional<double>& max_deviation) {
    constexpr double kLeastShare = 1e-9;
    const BoundingBox box = bounding_box(source);
    if (!max_deviation || box.empty()) return Done{};
    const double least = kLeastShare * std::max({box.diagonal(), box.min.cwiseAbs().maxCoeff(), box.max.cwiseAbs().maxCoeff()});
    if (*max_deviation >= least) return Done{};
    return invalid("max_deviation", number_text(*max_deviation),
                   "a length from " + number_text(least) + " on, which is what coordinates of this size resolve");
}

template <class Options>
Status check_on(const TriangleMesh& source, const Options& options) {
    if (Status s = check_resolved(source, options.max_deviation); !s) return s;
    if (Status s = check_features(source, options.marked_edges, options.regions); !s) return s;
    if (options.sizing) {
        if (Status s = check_sizing_on(source, *options.sizing); !s) return s;
    }
    return check_reachable(source, options);
}

/// A crease that ends freely and is shorter than this many tolerances is noise, if there is much of it. Extended mode only.
constexpr double kNoiseReach = 10;

template <class Options>
FeatureOptions features_of(const Options& options) {
    const bool extended = options.mode.value_or(Mode::kExtended) == Mode::kExtended;
    FeatureOptions features;
    features.detection = options.feature_detection.value_or(FeatureDetection::kDihedral);
    features.angle = options.feature_angle.value_or(kDefaultFeatureAngle);
    features.weight = options.feature_weight.value_or(kDefaultFeatureWeight);
    features.least_branch = extended ? kNoiseReach * options.tolerance.value_or(0) : 0;
    features.marked_edges = options.marked_edges;
    features.regions = options.regions;
    return features;
}

}  // namespace

Status check_options(const ImproveOptions& options) {
    if (Status s = check_range(options.subdivision_size, kPositive, "subdivision_size"); !s) return s;
    if (Status s = check_range(options.min_stretch, kStretch, "min_stretch"); !s) return s;
    if (Status s = check_range(options.min_mean_stretch, kStretch, "min_mean_stretch"); !s) return s;
    return check_common(options, {});
}

Status check_options(const ControlOptions& options) {
    if (options.subdivisions && *options.subdivisions > kMaxSubdivisions) {
        return invalid("subdivisions", std::to_string(*options.subdivisions), "0 to 12");
    }
    if (Status s = check_range(options.min_stretch, kStretch, "min_stretch"); !s) return s;
    if (Status s = check_range(options.max_size, kPositive, "max_size"); !s) return s;
    if (options.max_valence && *options.max_valence < kLeastValenceBound) {
        return invalid("max_valence", std::to_string(*options.max_valence),
                       "at least 6 (the mean valence of a closed mesh is about 6)");
    }
    if (Status s = check_face_bounds(options); !s) return s;
    if (options.min_size && options.sizing && check_sizing(*options.sizing, options.max_size)) {
        if (Status s = check_min_size_under(*options.min_size, *options.sizing); !s) return s;
    }
    return check_common(options, options.max_size);
}

Status check_options_on(const TriangleMesh& source, const ImproveOptions& options) { return check_on(source, options); }
Status check_options_on(const TriangleMesh& source, const ControlOptions& options) { return check_on(source, options); }

FeatureOptions feature_options(const ImproveOptions& options) { return features_of(options); }
FeatureOptions feature_options(const ControlOptions& options) { return features_of(options); }

std::optional<SizingOptions> sizing_options(const ImproveOptions& options) { return options.sizing; }

std::optional<SizingOptions> sizing_options(const ControlOptions& options) {
    if (!options.max_size) return options.sizing;
    SizingOptions sizing = options.sizing.value_or(SizingOptions());
    sizing.max_size = std::min(sizing.max_size.value_or(std::numeric_limits<double>::infinity()), *options.max_size);
    return sizing;
}

}  // namespace vsplit

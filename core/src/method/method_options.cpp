#include "vsplit/method/method_options.h"

#include <algorithm>
#include <limits>
#include <string>

#include "base/number_text.h"

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
};

constexpr Range kPositive{0, 1e300, false, "a positive finite length"};
constexpr Range kAngle{0, 180, true, "0 to 180 degrees"};
constexpr Range kWeight{0, 1e6, true, "0 to 1e6"};
constexpr Range kStretch{0, 1, true, "0 to 1"};
constexpr std::uint32_t kMaxSubdivisions = 12;
constexpr std::uint32_t kLeastValenceBound = 6;

Status check_range(const std::optional<double>& value, const Range& range, const char* field) {
    if (!value) return Done{};
    const bool inside = (range.low_included ? *value >= range.low : *value > range.low) && *value <= range.high;
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
    return options.sizing ? check_sizing_on(source, *options.sizing) : Status(Done{});
}

template <class Options>
FeatureOptions features_of(const Options& options) {
    return {options.feature_detection.value_or(FeatureDetection::kDihedral), options.feature_angle.value_or(kDefaultFeatureAngle),
            options.feature_weight.value_or(kDefaultFeatureWeight), options.marked_edges, options.regions};
}

}  // namespace

Status check_options(const ImproveOptions& options) {
    if (Status s = check_range(options.subdivision_size, kPositive, "subdivision_size"); !s) return s;
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

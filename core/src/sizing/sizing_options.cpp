#include "vsplit/sizing/sizing_options.h"

#include <string>

#include "base/number_text.h"
#include "mesh/coordinate.h"

namespace vsplit {
namespace {

constexpr double kLargestLength = 1e300;
constexpr const char* kPositive = "a positive finite length";

Error invalid(const std::string& field, const std::string& what, const std::string& was, const std::string& accepted) {
    return {Cause::kInvalidOption, what + " is " + was + "; accepted is " + accepted, field};
}

bool is_length(double value) { return value > 0 && value <= kLargestLength; }  // NaN is none

std::string nth(const std::string& field, std::size_t index, const char* member) {
    return field + "[" + std::to_string(index) + "]" + member;
}

std::string text(const Vec3& p) { return "(" + number_text(p.x()) + ", " + number_text(p.y()) + ", " + number_text(p.z()) + ")"; }

Status check_point(const Vec3& point, const std::string& field, const std::string& what) {
    if (is_valid_position(point)) return Done{};
    return invalid(field, what, text(point), "a point with coordinates of at most " + number_text(kLargestCoordinate));
}

Status check_size(double size, const std::string& field, const std::string& what) {
    return is_length(size) ? Status(Done{}) : invalid(field, what, number_text(size), kPositive);
}

Status check_spheres(const std::vector<SizeSphere>& spheres) {
    const std::string field = "sizing.spheres";
    for (std::size_t i = 0; i < spheres.size(); ++i) {
        if (Status s = check_point(spheres[i].center, field, nth(field, i, ".center")); !s) return s;
        if (!(spheres[i].radius >= 0 && spheres[i].radius <= kLargestLength)) {
            return invalid(field, nth(field, i, ".radius"), number_text(spheres[i].radius), "0 or a positive finite length");
        }
        if (Status s = check_size(spheres[i].size, field, nth(field, i, ".size")); !s) return s;
    }
    return Done{};
}

Status check_boxes(const std::vector<SizeBox>& boxes) {
    const std::string field = "sizing.boxes";
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        if (Status s = check_point(boxes[i].min, field, nth(field, i, ".min")); !s) return s;
        if (Status s = check_point(boxes[i].max, field, nth(field, i, ".max")); !s) return s;
        if ((boxes[i].max - boxes[i].min).minCoeff() < 0) {
            return invalid(field, nth(field, i, ".max"), text(boxes[i].max),
                           "nowhere less than min, which is " + text(boxes[i].min));
        }
        if (Status s = check_size(boxes[i].size, field, nth(field, i, ".size")); !s) return s;
    }
    return Done{};
}

Status check_field(const std::vector<double>& sizes) {
    for (std::size_t i = 0; i < sizes.size(); ++i) {
        if (sizes[i] == 0 || is_length(sizes[i])) continue;
        return invalid("sizing.field", nth("sizing.field", i, ""), number_text(sizes[i]),
                       "a positive finite length, or 0 for no bound");
    }
    return Done{};
}

Status check_length(const std::optional<double>& value, const std::string& field) {
    return value ? check_size(*value, field, field) : Status(Done{});
}

Status check_order(const std::optional<double>& min_size, const std::optional<double>& max_size, const std::string& max_field) {
    if (!min_size || !max_size || *min_size <= *max_size) return Done{};
    return invalid("sizing.min_size", "sizing.min_size", number_text(*min_size),
                   "at most " + max_field + ", which is " + number_text(*max_size));
}

}  // namespace

Status check_sizing(const SizingOptions& options, std::optional<double> max_size) {
    if (options.spheres.size() + options.boxes.size() > kMostShapes) {
        return invalid("sizing.spheres", "the number of spheres and boxes",
                       std::to_string(options.spheres.size() + options.boxes.size()),
                       "at most " + std::to_string(kMostShapes) + "; sizes of more places go into a field");
    }
    if (Status s = check_spheres(options.spheres); !s) return s;
    if (Status s = check_boxes(options.boxes); !s) return s;
    if (Status s = check_length(options.chord_error, "sizing.chord_error"); !s) return s;
    if (Status s = check_field(options.field); !s) return s;
    if (!(options.gradation > 0 && options.gradation <= kLargestGradation)) {
        return invalid("sizing.gradation", "sizing.gradation", number_text(options.gradation), "more than 0, at most 1");
    }
    if (Status s = check_length(options.min_size, "sizing.min_size"); !s) return s;
    if (Status s = check_length(options.max_size, "sizing.max_size"); !s) return s;
    if (Status s = check_order(options.min_size, options.max_size, "sizing.max_size"); !s) return s;
    return check_order(options.min_size, max_size, "max_size");
}

Status check_sizing_on(const TriangleMesh& mesh, const SizingOptions& options) {
    if (options.field.empty() || options.field.size() == mesh.positions.size()) return Done{};
    return Error{Cause::kInvalidOption,
                 "sizing.field holds " + std::to_string(options.field.size()) + " numbers; accepted is one for each of the " +
                     std::to_string(mesh.vertex_count()) + " vertices of the source, or none",
                 "sizing.field"};
}

}  // namespace vsplit

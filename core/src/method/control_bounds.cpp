#include "method/control_bounds.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "mesh/half_edges.h"
#include "vsplit/features/creases.h"
#include "vsplit/method/control.h"

namespace vsplit {
namespace {

constexpr double kRounding = 1e-12;
constexpr double kDegree = 0.017453292519943295;

double least_angle(const FaceFigures& face) { return std::asin(std::min(1.0, face.least_sine())) / kDegree; }
double largest_angle(const FaceFigures& face) { return std::acos(face.least_cosine()) / kDegree; }

/// Collects what breaks one bound.
class ViolationCounter {
public:
    ViolationCounter(const char* bound, std::optional<double> limit, bool lower_bound)
        : limited_(limit.has_value()), lower_bound_(lower_bound) {
        violation_.bound = bound;
        violation_.limit = violation_.worst = limit.value_or(0);
    }
    [[nodiscard]] bool limited() const { return limited_; }
    [[nodiscard]] double limit() const { return violation_.limit; }
    void add(std::uint32_t element, double value) {
        if (violation_.count++ < Violation::kMostElements) violation_.elements.push_back(element);
        violation_.worst = lower_bound_ ? std::min(violation_.worst, value) : std::max(violation_.worst, value);
    }
    void move_to(std::vector<Violation>& all) {
        if (violation_.count > 0) all.push_back(std::move(violation_));
    }

private:
    Violation violation_;
    bool limited_;
    bool lower_bound_;
};

void count_faces(const TriangleMesh& mesh, const ControlOptions& options, std::vector<Violation>& all) {
    const FaceBounds bounds = face_bounds(options);
    ViolationCounter stretch("min_stretch", options.min_stretch, true), max_size("max_size", options.max_size, false),
        min_angle("min_angle", options.min_angle, true), max_angle("max_angle", options.max_angle, false),
        aspect("max_aspect_ratio", options.max_aspect_ratio, false), min_size("min_size", options.min_size, true);
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
        const Triangle& t = mesh.faces[f];
        const FaceFigures face(mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]);
        if (bounds.lacks_stretch(face) > 0) stretch.add(f, face.stretch);
        if (max_size.limited() && face.longest > max_size.limit() * (1 + kRounding)) max_size.add(f, face.longest);
        if (bounds.lacks_min_angle(face) > 0) min_angle.add(f, least_angle(face));
        if (bounds.lacks_max_angle(face) > 0) max_angle.add(f, largest_angle(face));
        if (bounds.lacks_aspect(face) > 0) aspect.add(f, std::min(face.aspect(), std::numeric_limits<double>::max()));
        if (bounds.lacks_size(face) > 0) min_size.add(f, face.longest);
    }
    for (ViolationCounter* counter : {&stretch, &max_size, &min_angle, &max_angle, &aspect, &min_size}) counter->move_to(all);
}

void count_vertices(const TriangleMesh& mesh, std::uint32_t limit, std::vector<Violation>& all) {
    const std::vector<std::uint32_t> valence = valences(mesh);
    ViolationCounter counter("max_valence", limit, false);
    for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
        if (valence[v] > limit) counter.add(v, valence[v]);
    }
    counter.move_to(all);
}

/// How many creases end at each vertex.
std::vector<std::uint32_t> crease_ends(const TriangleMesh& mesh, const ControlOptions& options) {
    FeatureOptions features = feature_options(options);
    features.marked_edges.clear();  // of the source
    features.regions.clear();
    std::vector<std::uint32_t> ends(mesh.positions.size(), 0);
    for (const SharpEdge& edge : find_creases(mesh, face_normals(mesh), features)) {
        ++ends[edge.a];
        ++ends[edge.b];
    }
    return ends;
}

/// Of the elements listed: faces with all corners on creases, vertices where three creases or more meet.
std::size_t held_by_creases(const Violation& violation, const TriangleMesh& mesh, const std::vector<std::uint32_t>& ends) {
    const auto held = [&](std::uint32_t element) {
        if (violation.bound == "max_valence") return ends[element] > 2;
        const Triangle& t = mesh.faces[element];
        return std::all_of(t.begin(), t.end(), [&](std::uint32_t v) { return ends[v] > 0; });
    };
    return static_cast<std::size_t>(std::count_if(violation.elements.begin(), violation.elements.end(), held));
}

std::string what_was_tried(const Violation& violation, Mode mode) {
    const std::string what = violation.bound == "max_valence" ? "vertices" : "faces";
    if (mode == Mode::kStrict) return "no collapse before this resolution mended these " + what;
    return "no collapse, flip or move mended these " + what;
}

std::string what_would_help(const Violation& violation, const MethodResult& result, Mode mode) {
    std::string help = "a larger tolerance or looser bounds may";
    if (violation.bound == "min_size" && result.faces > result.mrr.faces_min()) help += ", and so may fewer faces";
    if (violation.bound != "min_size" && result.faces < result.mrr.faces_max()) help += ", and so may more faces";
    if (mode == Mode::kStrict) help += ", and so may mode EXTENDED";
    return help;
}

}  // namespace

FaceBounds face_bounds(const ControlOptions& options) {
    FaceBounds bounds;
    if (options.min_stretch) bounds.min_stretch = *options.min_stretch;
    if (options.min_size) bounds.min_size = *options.min_size * (1 - kRounding);
    if (options.min_angle) bounds.min_sine = std::sin(*options.min_angle * kDegree) * (1 - kRounding);
    if (options.max_angle) bounds.min_cosine = std::max(-1.0, std::cos(*options.max_angle * kDegree) - kRounding);
    if (options.max_aspect_ratio) bounds.max_aspect = *options.max_aspect_ratio * (1 + kRounding);
    return bounds;
}

std::vector<Violation> find_violations(const TriangleMesh& mesh, const ControlOptions& options) {
    std::vector<Violation> all;
    count_faces(mesh, options, all);
    if (options.max_valence) count_vertices(mesh, *options.max_valence, all);
    return all;
}

void explain(MethodResult& result, const TriangleMesh& mesh, const ControlOptions& options) {
    if (result.violations.empty()) return;
    const std::vector<std::uint32_t> ends = crease_ends(mesh, options);
    const Mode mode = options.mode.value_or(Mode::kExtended);
    for (Violation& violation : result.violations) {
        const std::size_t held = held_by_creases(violation, mesh, ends);
        const char* where =
            violation.bound == "max_valence" ? " are corners of creases, which stay" : " lie between creases, which stay";
        violation.reason = what_was_tried(violation, mode) + " within the tolerance and the other bounds";
        if (held > 0) violation.reason += "; " + std::to_string(held) + " of them" + where;
        violation.reason += "; " + what_would_help(violation, result, mode);
    }
}

}  // namespace vsplit

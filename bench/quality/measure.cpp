#include "quality/measure.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "quality/creases.h"
#include "quality/distance.h"
#include "vsplit/quality/self_intersections.h"

namespace vsplit::bench {
namespace {

/// The largest number where there are too many pairs to look at.
std::size_t count_self_intersections(const TriangleMesh& mesh) {
    const auto pairs = find_self_intersections(mesh);
    return pairs ? pairs->size() : std::numeric_limits<std::size_t>::max();
}

/// Degrees between normals of cosine -0.9.
constexpr double kFoldAngle = 154.1581;

/// Of the diagonal: a deviation that counts as none.
constexpr double kNegligible = 1e-9;

/// The i-th pair of the R2 sequence (Roberts 2018), which fills the unit square evenly.
std::array<double, 2> spread(std::size_t i) {
    const double n = static_cast<double>(i) + 0.5;
    const double u = 0.7548776662466927 * n;
    const double v = 0.5698402909980532 * n;
    return {u - std::floor(u), v - std::floor(v)};
}

/// Calls visit(element, sample) `samples` times, for each element as often as its weight asks.
template <class Visit>
void distribute(const std::vector<double>& weights, std::size_t samples, Visit visit) {
    double total = 0;
    for (const double w : weights) total += w;
    double sum = 0;
    std::size_t sample = 0;
    for (std::size_t i = 0; i < weights.size(); ++i) {
        sum += weights[i];
        while (sample < samples && (static_cast<double>(sample) + 0.5) * total < sum * static_cast<double>(samples)) {
            visit(i, sample++);
        }
    }
}

std::vector<Vec3> sample_surface(const TriangleMesh& mesh, std::size_t samples) {
    std::vector<double> areas;
    for (const Triangle& t : mesh.faces) {
        const Vec3& a = mesh.positions[t[0]];
        areas.push_back((mesh.positions[t[1]] - a).cross(mesh.positions[t[2]] - a).norm());
    }
    std::vector<Vec3> points = mesh.positions;
    points.reserve(points.size() + samples);
    distribute(areas, samples, [&](std::size_t face, std::size_t sample) {
        const Triangle& t = mesh.faces[face];
        const Vec3& a = mesh.positions[t[0]];
        auto [u, v] = spread(sample);
        if (u + v > 1) {
            u = 1 - u;
            v = 1 - v;
        }
        points.emplace_back(a + u * (mesh.positions[t[1]] - a) + v * (mesh.positions[t[2]] - a));
    });
    return points;
}

std::vector<Vec3> sample_segments(const std::vector<Segment>& segments, std::size_t samples) {
    std::vector<double> lengths;
    for (const Segment& s : segments) lengths.push_back((s[1] - s[0]).norm());
    std::vector<Vec3> points;
    distribute(lengths, samples, [&](std::size_t segment, std::size_t sample) {
        const Segment& s = segments[segment];
        points.emplace_back(s[0] + spread(sample)[0] * (s[1] - s[0]));
    });
    return points;
}

/// The largest distance of any point; 0 where all are within `negligible`. A point nearer than the farthest so far needs no exact
/// distance.
double farthest(const std::vector<Vec3>& points, const Distance& from, double negligible) {
    double result = negligible;
    for (const Vec3& p : points) result = std::max(result, from.distance(p, result));
    return result > negligible ? result : 0;
}

std::vector<Segment> creases(const TriangleMesh& mesh, double angle) {
    std::vector<Segment> segments = sharp_segments(mesh, angle);
    const std::vector<Segment> border = border_segments(mesh);
    segments.insert(segments.end(), border.begin(), border.end());
    return segments;
}

/// % of the points further than `near` from the edges of `result` sharper than `angle`.
std::optional<double> share_lost(const std::vector<Vec3>& points, const TriangleMesh& result, double angle, double near) {
    if (points.empty()) return std::nullopt;
    const Distance kept(creases(result, angle));
    const auto lost = std::count_if(points.begin(), points.end(), [&](const Vec3& p) { return kept.distance(p, near) > near; });
    return 100.0 * static_cast<double>(lost) / static_cast<double>(points.size());
}

std::size_t count_folds(const TriangleMesh& result, const TriangleMesh& source, double near) {
    const Distance excused(sharp_segments(source, kFoldAngle));
    const std::vector<Segment> folded = sharp_segments(result, kFoldAngle);
    return static_cast<std::size_t>(std::count_if(
        folded.begin(), folded.end(), [&](const Segment& s) { return excused.distance((s[0] + s[1]) / 2, near) > near; }));
}

}  // namespace

Figures measure(const TriangleMesh& result, const TriangleMesh& source, const MeasureOptions& options) {
    const double diagonal = bounding_box(source).diagonal();
    const double near = options.near / 100 * diagonal;
    Figures figures;
    figures.quality = measure_quality(result);
    const double negligible = kNegligible * diagonal;
    const double away = farthest(sample_surface(result, options.samples), Distance(source), negligible);
    const double back = farthest(sample_surface(source, options.samples), Distance(result), negligible);
    figures.deviation = 100 * std::max(away, back) / diagonal;
    const std::vector<Vec3> on_creases = sample_segments(creases(source, options.crease_angle), options.samples);
    figures.crease_lost = share_lost(on_creases, result, options.crease_angle, near);
    figures.crease_gone = share_lost(on_creases, result, options.crease_angle / 2, near);
    figures.folds = count_folds(result, source, near);
    figures.self_intersections = count_self_intersections(result);
    figures.source_self_intersections = count_self_intersections(source);
    figures.border_edges = border_segments(result).size();
    return figures;
}

}  // namespace vsplit::bench

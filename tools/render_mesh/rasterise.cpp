#include "rasterise.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

#include "vsplit/quality/stretch.h"

namespace vsplit::render {
namespace {

constexpr int kSamples = 3;         // a pixel's side in samples
constexpr double kLineWidth = 1.1;  // pixels
constexpr double kLineOpacity = 0.62;
constexpr double kOutlineOpacity = 0.85;
constexpr double kCreaseCosine = 0.8;    // faces that meet at a larger angle have a line between them
constexpr double kJump = 4.0;            // pixels: a step in depth that has a line
constexpr double kFadeHeight = 7.0;      // pixels: lines of faces lower than this fade, or slivers would be all line
constexpr double kMargin = 0.04;         // share of the picture's side left free
constexpr double kOcclusionRadius = 18;  // pixels

/// A corner in the picture: samples to the right, samples down, model units towards the viewer.
using Corner = Vec3;

/// How the face's plane answers the lights: one over the viewer's shoulder, one from the right, and the sky.
double brightness(const Vec3& normal) {
    static const Vec3 key = Vec3(-0.45, 0.70, 0.62).normalized();
    static const Vec3 fill = Vec3(0.85, 0.10, 0.45).normalized();
    const double light = 0.79 + 0.29 * std::max(0.0, normal.dot(key)) + 0.12 * std::max(0.0, normal.dot(fill));
    return std::min(light, 1.06);
}

Colour shaded(Colour colour, double light) {
    const auto factor = static_cast<float>(light);
    return {colour.red * factor, colour.green * factor, colour.blue * factor};
}

/// A picture with depth, in samples.
class Canvas {
public:
    Canvas(int width, int height)
        : picture_(width, height, kPanel),
          depth_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), -std::numeric_limits<float>::infinity()),
          face_(depth_.size(), 0) {}

    /// `normal` towards the viewer.
    void draw(const std::array<Corner, 3>& corners, const Vec3& normal, Colour colour);
    void darken_hollows(double units_per_sample);
    void draw_outlines(double units_per_sample);
    [[nodiscard]] Picture shrunk() const { return picture_.shrunk(kSamples); }

private:
    [[nodiscard]] std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(picture_.width()) + static_cast<std::size_t>(x);
    }
    [[nodiscard]] double depth(int x, int y) const { return depth_[index(x, y)]; }
    [[nodiscard]] bool empty(int x, int y) const { return std::isinf(depth_[index(x, y)]); }
    [[nodiscard]] double hollow(int x, int y, double units_per_sample) const;
    [[nodiscard]] bool line_between(int x, int y, int other_x, int other_y, double units_per_sample) const;

    Picture picture_;
    std::vector<float> depth_;
    std::vector<std::uint32_t> face_;  // of the sample, an index of normals_; meaningless where the sample is empty
    std::vector<Vec3> normals_;
};

/// Twice the signed area of (a, b, p).
double edge_function(const Corner& a, const Corner& b, double x, double y) {
    return (b.x() - a.x()) * (y - a.y()) - (b.y() - a.y()) * (x - a.x());
}

/// One face made ready for the sample loop.
struct Facet {
    std::array<Corner, 3> corners;
    std::array<double, 3> lengths{};  // samples; of the edge opposite each corner
    double area = 0;                  // samples^2, doubled, positive
    double line = 0;                  // opacity of its edges

    explicit Facet(const std::array<Corner, 3>& from) : corners(from) {
        area = edge_function(corners[0], corners[1], corners[2].x(), corners[2].y());
        if (area < 0) {
            std::swap(corners[1], corners[2]);
            area = -area;
        }
        for (std::size_t k = 0; k < 3; ++k) {
            lengths[k] = (corners[(k + 2) % 3] - corners[(k + 1) % 3]).head<2>().norm();
        }
        const double longest = std::max({lengths[0], lengths[1], lengths[2]});
        const double lowest = longest > 0 ? area / longest / kSamples : 0.0;
        line = kLineOpacity * std::clamp((lowest - 0.8) / kFadeHeight, 0.0, 1.0);
    }

    /// Weights of the corners at a sample; negative outside.
    [[nodiscard]] std::array<double, 3> weights(double x, double y) const {
        return {edge_function(corners[1], corners[2], x, y), edge_function(corners[2], corners[0], x, y),
                edge_function(corners[0], corners[1], x, y)};
    }

    /// Opacity of the line at a sample with these weights.
    [[nodiscard]] double line_at(const std::array<double, 3>& weights_there) const {
        double distance = std::numeric_limits<double>::infinity();
        for (std::size_t k = 0; k < 3; ++k) distance = std::min(distance, weights_there[k] / lengths[k]);
        return line * std::clamp(0.5 * kLineWidth * kSamples - distance + 0.5, 0.0, 1.0);
    }
};

void Canvas::draw(const std::array<Corner, 3>& corners, const Vec3& normal, Colour colour) {
    const Facet facet(corners);
    if (!(facet.area > 0)) return;
    const auto face = static_cast<std::uint32_t>(normals_.size());
    normals_.push_back(normal);
    const auto [left, right] = std::minmax({corners[0].x(), corners[1].x(), corners[2].x()});
    const auto [top, bottom] = std::minmax({corners[0].y(), corners[1].y(), corners[2].y()});
    const int last_x = static_cast<int>(std::min<double>(picture_.width() - 1, std::floor(right)));
    const int last_y = static_cast<int>(std::min<double>(picture_.height() - 1, std::floor(bottom)));
    for (int y = static_cast<int>(std::max(0.0, std::floor(top))); y <= last_y; ++y) {
        for (int x = static_cast<int>(std::max(0.0, std::floor(left))); x <= last_x; ++x) {
            const std::array<double, 3> weights = facet.weights(x + 0.5, y + 0.5);
            if (std::min({weights[0], weights[1], weights[2]}) < 0) continue;
            const double height =
                (weights[0] * facet.corners[0].z() + weights[1] * facet.corners[1].z() + weights[2] * facet.corners[2].z()) /
                facet.area;
            if (height <= depth(x, y)) continue;
            depth_[index(x, y)] = static_cast<float>(height);
            face_[index(x, y)] = face;
            picture_.set(x, y, mix(colour, kInk, facet.line_at(weights)));
        }
    }
}

/// Share of the surroundings that stand before this sample, 0 on open ground: what makes holes and corners readable.
double Canvas::hollow(int x, int y, double units_per_sample) const {
    constexpr int kDirections = 8;
    constexpr int kSteps = 3;
    const double here = depth(x, y);
    double sum = 0;
    for (int direction = 0; direction < kDirections; ++direction) {
        const double angle = 2 * std::numbers::pi * direction / kDirections;
        double steepest = 0;
        for (int step = 1; step <= kSteps; ++step) {
            const double reach = kOcclusionRadius * kSamples * step / kSteps;
            const int there_x = std::clamp(static_cast<int>(x + reach * std::cos(angle)), 0, picture_.width() - 1);
            const int there_y = std::clamp(static_cast<int>(y + reach * std::sin(angle)), 0, picture_.height() - 1);
            const double rise = (depth(there_x, there_y) - here) / (reach * units_per_sample);
            // What stands far before is another part of the body, not the wall of this hollow.
            if (rise > steepest) steepest = rise > 6 ? std::max(steepest, 0.6) : rise;
        }
        sum += steepest / std::hypot(1.0, steepest);
    }
    return sum / kDirections;
}

void Canvas::darken_hollows(double units_per_sample) {
    constexpr int kBlock = kSamples;
    for (int y = 0; y < picture_.height(); y += kBlock) {
        for (int x = 0; x < picture_.width(); x += kBlock) {
            const int middle_x = x + kBlock / 2;
            const int middle_y = y + kBlock / 2;
            if (empty(middle_x, middle_y)) continue;
            const double light = 1.0 - 0.42 * hollow(middle_x, middle_y, units_per_sample);
            for (int k = 0; k < kBlock * kBlock; ++k) {
                const int there_x = x + k % kBlock;
                const int there_y = y + k / kBlock;
                if (!empty(there_x, there_y)) picture_.set(there_x, there_y, shaded(picture_.at(there_x, there_y), light));
            }
        }
    }
}

/// Whether an outline or a crease passes between two samples that are close.
bool Canvas::line_between(int x, int y, int other_x, int other_y, double units_per_sample) const {
    if (empty(x, y) || empty(other_x, other_y)) return empty(x, y) != empty(other_x, other_y);
    const Vec3& here = normals_[face_[index(x, y)]];
    const Vec3& there = normals_[face_[index(other_x, other_y)]];
    if (here.dot(there) < kCreaseCosine) return true;
    // On a surface seen at a slant depth changes by itself.
    const double slope = std::max(here.head<2>().norm() / here.z(), there.head<2>().norm() / there.z());
    return std::abs(depth(x, y) - depth(other_x, other_y)) > (slope * 2 + kJump) * kSamples * units_per_sample;
}

void Canvas::draw_outlines(double units_per_sample) {
    constexpr int kReach = kSamples + 1;
    for (int y = 0; y < picture_.height() - kReach; ++y) {
        for (int x = 0; x < picture_.width() - kReach; ++x) {
            const bool line =
                line_between(x, y, x + kReach, y, units_per_sample) || line_between(x, y, x, y + kReach, units_per_sample);
            if (line) picture_.blend(x, y, kInk, kOutlineOpacity);
        }
    }
}

Vec3 project(const Camera& camera, const Vec3& point) {
    return {camera.right.dot(point), camera.up.dot(point), camera.toward.dot(point)};
}

}  // namespace

Camera orbit_camera(int up_axis, double azimuth, double elevation) {
    const Vec3 pole = Vec3::Unit(up_axis);
    const Vec3 ground_x = Vec3::Unit((up_axis + 1) % 3);
    const Vec3 ground_y = Vec3::Unit((up_axis + 2) % 3);
    const double turn = azimuth * std::numbers::pi / 180;
    const double lift = elevation * std::numbers::pi / 180;
    Camera camera;
    camera.toward = std::cos(lift) * (std::cos(turn) * ground_x + std::sin(turn) * ground_y) + std::sin(lift) * pole;
    camera.right = pole.cross(camera.toward).normalized();
    camera.up = camera.toward.cross(camera.right);
    return camera;
}

View fit_view(const Camera& camera, const std::vector<const TriangleMesh*>& meshes, int width, int height) {
    BoundingBox box;
    for (const TriangleMesh* mesh : meshes) {
        for (const Vec3& point : mesh->positions) {
            box.min = box.min.cwiseMin(project(camera, point));
            box.max = box.max.cwiseMax(project(camera, point));
        }
    }
    const Vec3 middle = 0.5 * (box.min + box.max);
    const Vec3 span = box.max - box.min;
    const double room = 1.0 - 2.0 * kMargin;
    return {middle.x(), middle.y(), std::max({span.x() / (room * width), span.y() / (room * height), 1e-12})};
}

Picture draw_mesh(const TriangleMesh& mesh, const Camera& camera, const View& view, int width, int height) {
    Canvas canvas(width * kSamples, height * kSamples);
    const double samples_per_unit = kSamples / view.units_per_pixel;
    const auto to_corner = [&](const Vec3& point) {
        const Vec3 there = project(camera, point);
        return Corner((there.x() - view.centre_x) * samples_per_unit + 0.5 * width * kSamples,
                      (view.centre_y - there.y()) * samples_per_unit + 0.5 * height * kSamples, there.z());
    };
    for (const Triangle& face : mesh.faces) {
        const Vec3& a = mesh.positions[face[0]];
        const Vec3& b = mesh.positions[face[1]];
        const Vec3& c = mesh.positions[face[2]];
        Vec3 normal = project(camera, (b - a).cross(c - a).normalized());
        if (normal.z() < 0) normal = -normal;
        const Colour colour = shaded(stretch_colour(stretch(a, b, c)), brightness(normal));
        canvas.draw({to_corner(a), to_corner(b), to_corner(c)}, normal, colour);
    }
    canvas.darken_hollows(1.0 / samples_per_unit);
    canvas.draw_outlines(1.0 / samples_per_unit);
    return canvas.shrunk();
}

}  // namespace vsplit::render

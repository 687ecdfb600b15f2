#include "vsplit/quality/element_quality.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <tuple>

#include "vsplit/quality/stretch.h"

namespace vsplit {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kDegrees = 180 / std::numbers::pi;

double angle_between(const Vec3& u, const Vec3& v) { return kDegrees * std::atan2(u.cross(v).norm(), u.dot(v)); }

/// Between lines: 0 to 90.
double angle_of_lines(const Vec3& u, const Vec3& v) {
    const double angle = angle_between(u, v);
    return std::min(angle, 180 - angle);
}

double skew_of(const std::array<Vec3, 3>& corner) {
    double least = 90;
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3& next = corner[(i + 1) % 3];
        const Vec3& other = corner[(i + 2) % 3];
        const Vec3 median = (next + other) / 2 - corner[i];
        const Vec3 middles = (other - next) / 2;  // from the middle of one side beside the corner to that of the other
        least = std::min(least, angle_of_lines(median, middles));
    }
    return 90 - least;
}

enum class Limits : bool { kLeast, kMost };

/// A figure and its limits: beyond `warn` a face is warned of, beyond `fail` it fails.
struct Criterion {
    std::string_view name;
    double ElementQuality::*figure;
    Limits limits;
    double warn;
    double fail;
};

using Q = ElementQuality;

constexpr std::array kStretch02{Criterion{"stretch", &Q::stretch, Limits::kLeast, 0.4, kStretchFloor}};

// Verdict has acceptable ranges only, so no warnings.
constexpr std::array kVerdict{Criterion{"aspect_ratio", &Q::aspect_ratio, Limits::kMost, 1.3, 1.3},
                              Criterion{"radius_ratio", &Q::radius_ratio, Limits::kMost, 3, 3},
                              Criterion{"min_angle", &Q::min_angle, Limits::kLeast, 30, 30},
                              Criterion{"max_angle", &Q::max_angle, Limits::kMost, 90, 90},
                              Criterion{"scaled_jacobian", &Q::scaled_jacobian, Limits::kLeast, 0.5, 0.5}};

constexpr std::array kOptistruct{
    Criterion{"edge_ratio", &Q::edge_ratio, Limits::kMost, 50, 500}, Criterion{"skew", &Q::skew, Limits::kMost, 75, 85},
    Criterion{"min_angle", &Q::min_angle, Limits::kLeast, 15, 3}, Criterion{"max_angle", &Q::max_angle, Limits::kMost, 165, 177}};

std::span<const Criterion> criteria_of(QualityProfile profile) {
    switch (profile) {
        case QualityProfile::kStretch02:
            return kStretch02;
        case QualityProfile::kVerdict:
            return kVerdict;
        case QualityProfile::kOptistruct:
            break;
    }
    return kOptistruct;
}

enum class Level : unsigned char { kPassed, kWarned, kFailed };

Level level_of(const Criterion& criterion, double value) {
    const auto within = [&](double limit) { return criterion.limits == Limits::kMost ? value <= limit : value >= limit; };
    if (!within(criterion.fail)) return Level::kFailed;
    return within(criterion.warn) ? Level::kPassed : Level::kWarned;
}

bool is_worse(const Criterion& criterion, double value, double other) {
    return criterion.limits == Limits::kMost ? value > other : value < other;
}

struct BadFace {
    bool passed_failure = false;  // warned of only
    double stretch = 0;
    std::uint32_t face = 0;

    friend bool operator<(const BadFace& l, const BadFace& r) {
        return std::tie(l.passed_failure, l.stretch, l.face) < std::tie(r.passed_failure, r.stretch, r.face);
    }
};

constexpr std::array kProfiles{QualityProfile::kStretch02, QualityProfile::kVerdict, QualityProfile::kOptistruct};

}  // namespace

ElementQuality element_quality(const Vec3& a, const Vec3& b, const Vec3& c) {
    const std::array<Vec3, 3> corner{a, b, c};
    std::array<double, 3> edge{};
    ElementQuality q;
    q.stretch = stretch(a, b, c);
    q.min_angle = 180;
    double perimeter = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3 to_next = corner[(i + 1) % 3] - corner[i];
        const double angle = angle_between(to_next, corner[(i + 2) % 3] - corner[i]);
        q.min_angle = std::min(q.min_angle, angle);
        q.max_angle = std::max(q.max_angle, angle);
        edge[i] = to_next.norm();
        perimeter += edge[i];
    }
    const auto [shortest, longest] = std::minmax({edge[0], edge[1], edge[2]});
    const double area = (b - a).cross(c - a).norm() / 2;
    const double twice_inradius = 4 * area / perimeter;
    q.skew = skew_of(corner);
    q.edge_ratio = shortest > 0 ? longest / shortest : kInfinity;
    if (!(area > 0)) {
        q.aspect_ratio = q.radius_ratio = kInfinity;
        return q;
    }
    q.aspect_ratio = longest / (std::numbers::sqrt3 * twice_inradius);
    q.radius_ratio = edge[0] * edge[1] * edge[2] / (4 * area) / twice_inradius;
    const double most_product = std::max({edge[0] * edge[1], edge[1] * edge[2], edge[2] * edge[0]});
    q.scaled_jacobian = 4 * area / (std::numbers::sqrt3 * most_product);
    return q;
}

std::string_view profile_name(QualityProfile profile) {
    switch (profile) {
        case QualityProfile::kStretch02:
            return "stretch-02";
        case QualityProfile::kVerdict:
            return "verdict";
        case QualityProfile::kOptistruct:
            break;
    }
    return "optistruct";
}

Expected<QualityProfile> profile_by_name(std::string_view name) {
    for (const QualityProfile profile : kProfiles) {
        if (profile_name(profile) == name) return profile;
    }
    return Error{Cause::kInvalidOption,
                 "no profile is called '" + std::string(name) + "'; known are stretch-02, verdict, optistruct", "profile"};
}

ProfileReport check_profile(const TriangleMesh& mesh, QualityProfile profile, std::size_t worst) {
    const std::span<const Criterion> criteria = criteria_of(profile);
    ProfileReport report;
    report.profile = profile;
    for (const Criterion& criterion : criteria) {
        const bool upper = criterion.limits == Limits::kMost;
        report.criteria.push_back(
            {std::string(criterion.name), upper ? 0 : kInfinity, 0, 0, 0, upper, criterion.warn, criterion.fail});
    }
    std::vector<BadFace> bad;
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
        const Triangle& t = mesh.faces[f];
        const ElementQuality q = element_quality(mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]);
        Level face_level = Level::kPassed;
        for (std::size_t i = 0; i < criteria.size(); ++i) {
            CriterionReport& of = report.criteria[i];
            const double value = q.*criteria[i].figure;
            const Level level = level_of(criteria[i], value);
            of.warned += level == Level::kWarned ? 1 : 0;
            of.failed += level == Level::kFailed ? 1 : 0;
            face_level = std::max(face_level, level);
            if (!is_worse(criteria[i], value, of.worst)) continue;
            of.worst = value;
            of.worst_face = f;
        }
        ++(face_level == Level::kPassed ? report.passed : face_level == Level::kWarned ? report.warned : report.failed);
        if (face_level != Level::kPassed) bad.push_back({face_level == Level::kWarned, q.stretch, f});
    }
    const std::size_t listed = std::min(worst, bad.size());
    std::partial_sort(bad.begin(), bad.begin() + static_cast<std::ptrdiff_t>(listed), bad.end());
    for (std::size_t i = 0; i < listed; ++i) report.worst.push_back(bad[i].face);
    return report;
}

}  // namespace vsplit

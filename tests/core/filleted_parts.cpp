#include "tests/core/filleted_parts.h"

#include <array>
#include <cassert>
#include <cmath>
#include <map>
#include <numbers>

#include "repair/loop_triangulation.h"

namespace vsplit::test {
namespace {

using Point = Eigen::Vector2d;
using Ring = std::vector<std::uint32_t>;

/// Adds the points of an arc with both its ends.
void add_arc(std::vector<Point>& points, const Point& centre, double radius, double from, double to, std::uint32_t strips) {
    for (std::uint32_t i = 0; i <= strips; ++i) {
        const double angle = (from + (to - from) * i / strips) * std::numbers::pi / 180;
        points.push_back(centre + radius * Point(std::cos(angle), std::sin(angle)));
    }
}

/// The prism over a polygon that runs counter-clockwise.
TriangleMesh extruded(const std::vector<Point>& profile, double length) {
    TriangleMesh mesh;
    const auto n = static_cast<std::uint32_t>(profile.size());
    for (const double z : {0.0, length}) {
        for (const Point& p : profile) mesh.positions.emplace_back(p.x(), p.y(), z);
    }
    const auto everywhere = [](std::uint32_t, std::uint32_t) { return true; };
    for (const Triangle& t : triangulate_loop({mesh.positions.data(), n}, everywhere)) {
        mesh.faces.push_back({t[0], t[2], t[1]});
        mesh.faces.push_back({n + t[0], n + t[1], n + t[2]});
    }
    for (std::uint32_t i = 0; i < n; ++i) {
        const std::uint32_t k = (i + 1) % n;
        mesh.faces.push_back({i, k, n + k});
        mesh.faces.push_back({i, n + k, n + i});
    }
    return mesh;
}

class TurnedPlate {
public:
    explicit TurnedPlate(std::uint32_t around) : around_(around) {
        for (const double z : {0.0, -5.0}) {
            for (const Point& p : {Point(30, 30), Point(0, 30), Point(0, 0), Point(30, 0)})
                mesh_.positions.emplace_back(p.x(), p.y(), z);
        }
        for (std::uint32_t i = 0; i < 4; ++i) wall(4 + (i + 1) % 4, (i + 1) % 4, 4 + i, i);
    }

    /// Turns (distance from the axis, height) points around it: from the plate's top on.
    TriangleMesh build(const std::vector<Point>& profile, bool through) {
        Ring last = ring(profile.front());
        plane(last, 0, false);
        for (std::size_t i = 1; i < profile.size(); ++i) {
            const Ring here = ring(profile[i]);
            for (std::uint32_t k = 0; k < around_; ++k) wall(last[k], last[(k + 1) % around_], here[k], here[(k + 1) % around_]);
            last = here;
        }
        if (through) {
            plane(last, 4, true);
            return std::move(mesh_);
        }
        for (std::uint32_t k = 1; k + 1 < around_; ++k) face(last[0], last[k], last[k + 1], false);
        face(4, 5, 6, true);
        face(4, 6, 7, true);
        return std::move(mesh_);
    }

private:
    void face(std::uint32_t a, std::uint32_t b, std::uint32_t c, bool turned) {
        mesh_.faces.push_back(turned ? Triangle{a, c, b} : Triangle{a, b, c});
    }

    void wall(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
        face(a, b, c, false);
        face(b, d, c, false);
    }

    Ring ring(const Point& at) {
        Ring all;
        for (std::uint32_t k = 0; k < around_; ++k) {
            const double angle = 2 * std::numbers::pi * k / around_;
            all.push_back(mesh_.vertex_count());
            mesh_.positions.emplace_back(15 + at.x() * std::cos(angle), 15 + at.x() * std::sin(angle), at.y());
        }
        return all;
    }

    /// The square of the corners from `first` on around a ring: a fan from each.
    void plane(const Ring& ring, std::uint32_t first, bool turned) {
        const std::uint32_t n = around_;
        assert(n > 0);
        for (std::uint32_t k = 0; k < n; ++k) face(ring[k], first + 4 * k / n, ring[(k + 1) % n], turned);
        for (std::uint32_t q = 0; q < 4; ++q) face(first + q, first + (q + 1) % 4, ring[(q + 1) * n / 4 % n], turned);
    }

    std::uint32_t around_;
    TriangleMesh mesh_;
};

}  // namespace

TriangleMesh rounded_block(double radius, std::uint32_t strips, double length) {
    std::vector<Point> profile{{0, 0}, {20, 0}};
    if (radius > 0) {
        add_arc(profile, {20 - radius, 10 - radius}, radius, 0, 90, strips);
    } else {
        profile.emplace_back(20, 10);
    }
    profile.emplace_back(0, 10);
    return extruded(profile, length);
}

TriangleMesh rounded_angle(double radius, std::uint32_t strips, double length) {
    std::vector<Point> profile{{0, 0}, {20, 0}, {20, 5}};
    add_arc(profile, {5 + radius, 5 + radius}, radius, 270, 180, strips);
    profile.emplace_back(5, 20);
    profile.emplace_back(0, 20);
    return extruded(profile, length);
}

TriangleMesh boss_with_rounded_foot(double radius, std::uint32_t strips, std::uint32_t around) {
    std::vector<Point> profile;
    add_arc(profile, {6 + radius, radius}, radius, 270, 180, strips);
    profile.emplace_back(6, 8);
    return TurnedPlate(around).build(profile, false);
}

TriangleMesh hole_with_rounded_mouth(double radius, std::uint32_t strips, std::uint32_t around) {
    std::vector<Point> profile;
    add_arc(profile, {6 + radius, -radius}, radius, 90, 180, strips);
    profile.emplace_back(6, -5);
    return TurnedPlate(around).build(profile, true);
}

TriangleMesh rounded_slab(double radius, std::uint32_t strips, std::uint32_t around) {
    std::vector<Point> profile{{8, 0}};
    add_arc(profile, {8 - radius, 6 - radius}, radius, 0, 90, strips);
    TriangleMesh mesh;
    const std::uint32_t n = 2 * (around + 1);
    for (const Point& p : profile) {
        for (std::uint32_t k = 0; k < n; ++k) {
            const bool far = k > around;
            const double angle = std::numbers::pi * ((far ? k - 1 : k) / static_cast<double>(around) - 0.5);
            mesh.positions.emplace_back((far ? -15 : 15) + p.x() * std::cos(angle), p.x() * std::sin(angle), p.y());
        }
    }
    for (std::uint32_t row = 0; row + 1 < profile.size(); ++row) {
        for (std::uint32_t k = 0; k < n; ++k) {
            const std::uint32_t a = row * n + k, b = row * n + (k + 1) % n;
            mesh.faces.push_back({a, b, b + n});
            mesh.faces.push_back({a, b + n, a + n});
        }
    }
    const std::uint32_t top = (static_cast<std::uint32_t>(profile.size()) - 1) * n;
    for (std::uint32_t k = 1; k + 1 < n; ++k) {
        mesh.faces.push_back({0, k + 1, k});
        mesh.faces.push_back({top, top + k, top + k + 1});
    }
    return mesh;
}

TriangleMesh rounded_box(const Vec3& sides, double radius, std::uint32_t strips) {
    // A globe whose octants are drawn apart: between them come strips and planes.
    TriangleMesh mesh;
    const Vec3 apart = sides / 2 - Vec3::Constant(radius);
    std::map<std::array<long, 3>, std::uint32_t> places;
    const auto vertex = [&](std::uint32_t row, std::uint32_t column) {
        const std::uint32_t per_quarter = strips + 1;
        const double up = (row / per_quarter == 0 ? -90.0 : 0) + 90.0 * (row % per_quarter) / strips;
        const std::uint32_t quarter = column / per_quarter % 4;
        const double turn = 90.0 * quarter + 90.0 * (column % per_quarter) / strips;
        const double latitude = up * std::numbers::pi / 180, longitude = turn * std::numbers::pi / 180;
        const Vec3 out(std::cos(latitude) * std::cos(longitude), std::cos(latitude) * std::sin(longitude), std::sin(latitude));
        const Vec3 octant(quarter == 0 || quarter == 3 ? 1 : -1, quarter < 2 ? 1 : -1, row / per_quarter == 0 ? -1 : 1);
        const Vec3 p = octant.cwiseProduct(apart) + radius * out;
        const auto [found, fresh] = places.try_emplace(
            {std::lround(1e6 * p.x()), std::lround(1e6 * p.y()), std::lround(1e6 * p.z())}, mesh.vertex_count());
        if (fresh) mesh.positions.push_back(p);
        return found->second;
    };
    const auto face = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        if (a != b && b != c && c != a) mesh.faces.push_back({a, b, c});
    };
    const std::uint32_t rows = 2 * (strips + 1), columns = 4 * (strips + 1);
    for (std::uint32_t r = 0; r + 1 < rows; ++r) {
        for (std::uint32_t c = 0; c < columns; ++c) {
            face(vertex(r, c), vertex(r, c + 1), vertex(r + 1, c + 1));
            face(vertex(r, c), vertex(r + 1, c + 1), vertex(r + 1, c));
        }
    }
    for (const std::uint32_t r : {0U, rows - 1}) {
        std::array<std::uint32_t, 4> corners{};
        for (std::uint32_t q = 0; q < 4; ++q) corners[r == 0 ? 3 - q : q] = vertex(r, q * (strips + 1));
        face(corners[0], corners[1], corners[2]);
        face(corners[0], corners[2], corners[3]);
    }
    return mesh;
}

}  // namespace vsplit::test

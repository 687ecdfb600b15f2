#include "tests/core/drilled_plate.h"

#include <array>
#include <cmath>
#include <map>
#include <numbers>

namespace vsplit::test {
namespace {

class PlateBuilder {
public:
    PlateBuilder(std::uint32_t columns, double pitch, double thickness)
        : columns_(columns), pitch_(pitch), thickness_(thickness) {}

    TriangleMesh build(const std::vector<Drilling>& drillings) {
        const auto rows = static_cast<std::uint32_t>(drillings.size()) / columns_;
        for (std::uint32_t i = 0; i < rows * columns_; ++i) square(i % columns_, i / columns_, drillings[i]);
        for (std::uint32_t c = 0; c < columns_; ++c) {
            wall(corner(c, 0, false), corner(c + 1, 0, false), corner(c + 1, 0, true), corner(c, 0, true));
            wall(corner(c + 1, rows, false), corner(c, rows, false), corner(c, rows, true), corner(c + 1, rows, true));
        }
        for (std::uint32_t r = 0; r < rows; ++r) {
            wall(corner(0, r + 1, false), corner(0, r, false), corner(0, r, true), corner(0, r + 1, true));
            wall(corner(columns_, r, false), corner(columns_, r + 1, false), corner(columns_, r + 1, true),
                 corner(columns_, r, true));
        }
        return std::move(mesh_);
    }

private:
    using Ring = std::vector<std::uint32_t>;
    using Corners = std::array<std::uint32_t, 4>;

    std::uint32_t add(const Vec3& p) {
        mesh_.positions.push_back(p);
        return mesh_.vertex_count() - 1;
    }

    std::uint32_t corner(std::uint32_t c, std::uint32_t r, bool top) {
        const auto [found, fresh] = corners_.try_emplace({c, r, top}, mesh_.vertex_count());
        if (fresh) add({c * pitch_, r * pitch_, top ? 0 : -thickness_});
        return found->second;
    }

    void face(std::uint32_t a, std::uint32_t b, std::uint32_t c, bool turned = false) {
        mesh_.faces.push_back(turned ? Triangle{a, c, b} : Triangle{a, b, c});
    }

    void wall(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
        face(a, b, c);
        face(a, c, d);
    }

    Ring ring(std::uint32_t c, std::uint32_t r, const Drilling& drilling, double z) {
        Ring all;
        for (std::uint32_t k = 0; k < drilling.sides; ++k) {
            const double angle = 2 * std::numbers::pi * k / drilling.sides, radius = drilling.diameter / 2;
            all.push_back(add({(c + 0.5) * pitch_ + radius * std::cos(angle), (r + 0.5) * pitch_ + radius * std::sin(angle), z}));
        }
        return all;
    }

    /// The square around a ring: a fan from each corner.
    void around(const Corners& outer, const Ring& inner, bool turned) {
        const std::size_t n = inner.size();
        if (n == 0) return;
        for (std::size_t k = 0; k < n; ++k) face(inner[k], outer[4 * k / n], inner[(k + 1) % n], turned);
        for (std::size_t q = 0; q < 4; ++q) face(outer[q], outer[(q + 1) % 4], inner[(q + 1) * n / 4 % n], turned);
    }

    /// From the side where the first square begins, counter-clockwise, beginning at the quarter of the angles 0 to 90 degrees.
    Corners corners_of(std::uint32_t c, std::uint32_t r, bool top) {
        return {corner(c + 1, r + 1, top), corner(c, r + 1, top), corner(c, r, top), corner(c + 1, r, top)};
    }

    void square(std::uint32_t c, std::uint32_t r, const Drilling& drilling) {
        const bool through = drilling.depth >= thickness_;
        const Ring rim = ring(c, r, drilling, 0), end = ring(c, r, drilling, -drilling.depth);
        const std::size_t n = rim.size();
        around(corners_of(c, r, true), rim, false);
        for (std::size_t k = 0; k < n; ++k) {
            face(rim[k], rim[(k + 1) % n], end[k]);
            face(rim[(k + 1) % n], end[(k + 1) % n], end[k]);
        }
        const Corners below = corners_of(c, r, false);
        if (through) return around(below, end, true);
        for (std::size_t k = 1; k + 1 < n; ++k) face(end[0], end[k], end[k + 1]);
        face(below[0], below[2], below[1]);
        face(below[0], below[3], below[2]);
    }

    std::uint32_t columns_;
    double pitch_;
    double thickness_;
    TriangleMesh mesh_;
    std::map<std::array<std::uint32_t, 3>, std::uint32_t> corners_;
};

}  // namespace

TriangleMesh drilled_plate(std::uint32_t columns, double pitch, double thickness, const std::vector<Drilling>& drillings) {
    return PlateBuilder(columns, pitch, thickness).build(drillings);
}

std::vector<Drilling> forty_drillings(double thickness) {
    std::vector<Drilling> all;
    for (std::uint32_t i = 0; i < 40; ++i) {
        const bool blind = i % 4 == 3;
        all.push_back({2.0 + i % 5, blind ? thickness / 2 : thickness, 16 + 4 * (i % 3)});
    }
    return all;
}

double polygon_area(double diameter, std::uint32_t sides) {
    return sides * diameter * diameter / 8 * std::sin(2 * std::numbers::pi / sides);
}

}  // namespace vsplit::test

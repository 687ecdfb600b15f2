#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cstdint>
#include <limits>

#include "quality/face_shape.h"
#include "vsplit/mesh/triangle_mesh.h"

namespace vsplit {

/// What all bounds on a face's shape are told by: its sides in order, twice its area, its stretch.
struct FaceFigures {
    double longest = 0;
    double middle = 0;
    double shortest = 0;
    double twice_area = 0;
    double stretch = 0;

    FaceFigures(const Vec3& a, const Vec3& b, const Vec3& c) : twice_area((b - a).cross(c - a).norm()) {
        const double ab = (b - a).norm(), bc = (c - b).norm(), ca = (a - c).norm();
        longest = std::max({ab, bc, ca});
        shortest = std::min({ab, bc, ca});
        middle = std::max(std::min(ab, bc), std::min(std::max(ab, bc), ca));
        stretch = stretch_of(ab, bc, ca, twice_area);
    }

    /// Longest over shortest side, at least 1; infinite where a side has no length.
    [[nodiscard]] double aspect() const { return shortest > 0 ? longest / shortest : std::numeric_limits<double>::infinity(); }
    /// Of the smallest angle, which lies between the two longer sides.
    [[nodiscard]] double least_sine() const { return middle > 0 ? twice_area / (longest * middle) : 0; }
    /// Of the largest angle, which lies between the two shorter sides; -1 where a side has no length.
    [[nodiscard]] double least_cosine() const {
        if (!(shortest > 0)) return -1;
        return std::max(-1.0, (shortest * shortest + middle * middle - longest * longest) / (2 * shortest * middle));
    }
};

/// How far some faces are from keeping their bounds: nothing where all hold.
struct Excess {
    double worst = 0;  ///< of one face
    double sum = 0;
    std::uint8_t kinds = 0;  ///< a bit for each bound that is broken

    void add(const Excess& other) {
        worst = std::max(worst, other.worst);
        sum += other.sum;
        kinds |= other.kinds;
    }
    [[nodiscard]] bool none() const { return sum == 0; }
    /// Less in all, nowhere more than the worst face before, and by no bound that held on all faces.
    [[nodiscard]] bool lessens(const Excess& before) const {
        return worst <= before.worst && sum < before.sum && (kinds | before.kinds) == before.kinds;
    }
    /// What a flip or a move may leave where `before` was.
    [[nodiscard]] bool may_follow(const Excess& before) const { return none() || lessens(before); }
};

/// The bounds of property control on the shape of one face. What is larger than a length somewhere (max_size) stands apart: it is
/// a limit of a place, not of a shape.
struct FaceBounds {
    double min_stretch = 0;
    double min_size = 0;     ///< of the longest side
    double min_sine = 0;     ///< of the smallest angle
    double min_cosine = -1;  ///< of the largest angle
    double max_aspect = std::numeric_limits<double>::infinity();

    /// Whether there is a bound beside that on stretch, which is known of every face without looking.
    [[nodiscard]] bool shaped() const {
        return min_size > 0 || min_sine > 0 || min_cosine > -1 || max_aspect < std::numeric_limits<double>::infinity();
    }

    // What a face lacks to keep a bound, as a share of it: 0 to 1, and 0 only where it holds.
    [[nodiscard]] double lacks_stretch(const FaceFigures& face) const { return share_under(face.stretch, min_stretch); }
    [[nodiscard]] double lacks_size(const FaceFigures& face) const { return share_under(face.longest, min_size); }
    [[nodiscard]] double lacks_min_angle(const FaceFigures& face) const { return share_under(face.least_sine(), min_sine); }
    [[nodiscard]] double lacks_max_angle(const FaceFigures& face) const {
        return share_under(1 + face.least_cosine(), 1 + min_cosine);
    }
    [[nodiscard]] double lacks_aspect(const FaceFigures& face) const { return share_under(1 / face.aspect(), 1 / max_aspect); }

    /// All that it lacks.
    [[nodiscard]] Excess excess(const FaceFigures& face) const {
        Excess all;
        std::uint8_t kind = 1;
        for (const double lack :
             {lacks_stretch(face), lacks_size(face), lacks_min_angle(face), lacks_max_angle(face), lacks_aspect(face)}) {
            all.sum += lack;
            if (lack > 0) all.kinds |= kind;
            kind = static_cast<std::uint8_t>(kind << 1U);
        }
        all.worst = all.sum;
        return all;
    }

private:
    [[nodiscard]] static double share_under(double value, double least) { return value < least ? (least - value) / least : 0; }
};

}  // namespace vsplit

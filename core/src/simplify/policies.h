#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>

#include "quality/face_bounds.h"
#include "simplify/fan.h"
#include "vsplit/quality/stretch.h"
#include "vsplit/simplify/quadric.h"

namespace vsplit {

/// The faces around the ends of an edge before its collapse, those that vanish included.
struct Before {
    double faces = 0;
    double stretch_sum = 0;
    double stretch_min = 0;
    double weight_sum = 0;  ///< of the policy's face_weight
    double vanishing = 2;   ///< of the faces; on a boundary one
    Excess excess{};        ///< where the policy is shaped()
};

/// q(F) of the faces after a collapse, [Date05] Eq. 8: min St * mean St, at most 1.
[[nodiscard]] inline double shape_quality(const Fan::Shape& after, std::size_t faces) {
    return std::min(1.0, after.stretch_min * after.stretch_sum / static_cast<double>(faces));
}

// A policy says which collapses are valid beyond topology, fold-over and tolerance, and in which order valid ones go. The
// priorities of both methods are a factor known before the collapse times shape_quality after it.

/// What the paper leaves as it is and the extended mode does not. No bound on a face's shape unless the method sets one.
struct StrictRules : FaceBounds {
    /// Creases are kept by their quadrics alone, shape by collapses alone.
    static constexpr bool kExtended = false;

    double floor = 0;  ///< of stretch: no collapse leaves a face under it where none was; the paper has none

    [[nodiscard]] bool keeps_floor(const Before& before, const Fan::Shape& after) const {
        return after.stretch_min >= std::min(floor, before.stretch_min);
    }

    /// The largest error of a place; `square` is the tolerance squared.
    [[nodiscard]] static double error_limit(const Quadric& /*quadric*/, double square) { return square; }

    /// Of a policy that is shaped(): beside `admits`.
    [[nodiscard]] static bool admits_excess(const Before& /*before*/, const Excess& after) { return after.none(); }
};

/// Mesh quality improvement ([Date05] 4.2): rho = s * q(after) / q(before), q = min St * mean St, s = faces / sum of sizes.
struct ImprovePolicy : StrictRules {
    /// A degenerate face is the most urgent case: above any finite ratio, ordered by size.
    static constexpr double kUrgent = 1e100;
    static constexpr double kDegenerate = 1e-30;

    [[nodiscard]] static bool two_phases() { return false; }
    static void enter_phase(int /*phase*/) {}
    [[nodiscard]] static double face_weight(double size) { return size; }
    [[nodiscard]] static bool eligible(const Before& /*before*/) { return true; }
    [[nodiscard]] static bool admits_valence(std::uint32_t /*valence*/) { return true; }
    [[nodiscard]] bool admits(const Before& before, const Fan::Shape& after) const { return keeps_floor(before, after); }

    [[nodiscard]] static double factor(const Before& before) {
        const double s = before.weight_sum > 0 ? before.faces / before.weight_sum : kUrgent;
        const double q = before.stretch_min * before.stretch_sum / before.faces;
        return q > kDegenerate ? s / q : s * kUrgent;
    }
};

/// Mesh property control ([Date05] 5.2, Eq. 9): bounds on stretch, size and valence, and beyond the paper all of FaceBounds;
/// rho = 1 / (2 (n - 1)) * sum_before(tau_SZ / Sz) * min St * sum St over the n faces after.
struct ControlPolicy : StrictRules {
    double max_size = std::numeric_limits<double>::infinity();
    std::uint32_t max_valence = std::numeric_limits<std::uint32_t>::max();
    double size_unit = 1;         ///< tau_SZ where there is a bound, else any length: it scales all priorities alike
    bool only_violators = false;  ///< phase one: only collapses that touch a face which breaks a bound on its shape

    [[nodiscard]] static bool two_phases() { return true; }
    void enter_phase(int phase) { only_violators = phase == 1; }
    [[nodiscard]] double face_weight(double size) const { return size > 0 ? size_unit / size : kPointWeight; }
    [[nodiscard]] bool eligible(const Before& before) const {
        return !only_violators || before.stretch_min < min_stretch || !before.excess.none();
    }
    [[nodiscard]] bool admits_valence(std::uint32_t valence) const { return valence <= max_valence; }
    /// In phase one a collapse may also leave a violator that is less of one: a strip of slivers mends a step at a time.
    [[nodiscard]] bool admits(const Before& before, const Fan::Shape& after) const {
        const bool mends = only_violators && after.stretch_min > before.stretch_min;
        return (after.stretch_min >= min_stretch || mends || shaped()) && after.size_max <= max_size &&
               keeps_floor(before, after);
    }
    /// Stretch included: `admits` leaves all shape to this.
    [[nodiscard]] bool admits_excess(const Before& before, const Excess& after) const {
        return after.none() || (only_violators && after.lessens(before.excess));
    }
    /// With n faces after, 1 / (2 (n - 1)) * min St * sum St = n / (2 (n - 1)) * shape quality. Inside n is at least 3; at the
    /// end of a boundary it may be 1.
    [[nodiscard]] static double factor(const Before& before) {
        const double n = before.faces - before.vanishing;
        return before.weight_sum * n / (2 * std::max(n - 1, 1.0));
    }

private:
    static constexpr double kPointWeight = 1e100;
};

/// A sum over many planes bounds their mean distance ever closer, until nothing on a curved surface may move. This bounds the
/// mean of the squares instead (a quadric's trace is the sum of its weights), and never asks for less than the strict limit,
/// `square`.
[[nodiscard]] inline double mean_error_limit(const Quadric& quadric, double square) {
    return square * std::max(1.0, quadric.trace());
}

/// Least stretch that collapses of the extended mode leave, where nothing else is asked for.
inline constexpr double kExtendedFloor = 0.4;

/// The extended mode of either method (docs/method.md): collapses keep creases apart and valences even, and the simplifier flips
/// edges and moves vertices between them.
template <class Method>
struct Extended : Method {
    static constexpr bool kExtended = true;

    [[nodiscard]] static double error_limit(const Quadric& quadric, double square) { return mean_error_limit(quadric, square); }
};

}  // namespace vsplit

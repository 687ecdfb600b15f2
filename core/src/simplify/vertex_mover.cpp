#include "simplify/vertex_mover.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <utility>

#include "mesh/coordinate.h"
#include "simplify/placement.h"
#include "simplify/policies.h"

namespace vsplit {
namespace {

constexpr double kEquilateralHeight = 0.8660254037844386;  // of edge 1

// Where the surface bends, a vertex can nearly always go somewhere that is a little better, and each move is a record: with the
// gain that counts elsewhere the moves of a scan take half as many bytes again, for a mean stretch 0.01 better.
constexpr double kLeastGainOnCurves = 0.014;
constexpr double kLeastBend = 1e-3;  // share of a quadric across the normal: normals differ by some 2 degrees

// The pattern of `lift`: eight directions, steps from this share of the longest edge down by halves.
constexpr double kFirstStep = 0.2;
constexpr int kHalvings = 5;
constexpr double kDiagonal = 0.7071067811865476;
constexpr std::array<std::pair<double, double>, 8> kPattern{{{1, 0},
                                                             {-1, 0},
                                                             {0, 1},
                                                             {0, -1},
                                                             {kDiagonal, kDiagonal},
                                                             {-kDiagonal, kDiagonal},
                                                             {kDiagonal, -kDiagonal},
                                                             {-kDiagonal, -kDiagonal}}};

}  // namespace

bool VertexMover::gather_star(std::uint32_t v) {
    if (mesh_.valence(v) > Fan::kCapacity || state_.border.hold(v) > Hold::kAlong) return false;
    vertex_ = v;
    std::size_t t = 0;
    bool is_on_crease = false;
    mesh_.for_each_outgoing(v, [&](HalfEdge h) {
        const std::uint32_t r = mesh_.target(h);
        is_on_crease |= mesh_.is_crease(h);
        star_.put(t++, r, mesh_.position(r), face_of(h), state_.faces[face_of(h)].normal);
    });
    const std::uint32_t ghost = state_.border.ghost_beside(v);
    ghost == kNone ? star_.close(t) : star_.open_at(ghost, t);
    normal_ = Vec3::Zero();
    for (std::size_t n = 0; n < star_.size(); ++n) normal_ += star_.old_normal(n);
    normal_.normalize();
    shape_ = star_.shape_at(mesh_.position(v));
    quadric_ = state_.quadrics[v];
    // A vertex that goes far takes what sizes are allowed from its neighbours, which is too late where those grow fast.
    steepness_ = ghost == kNone && !is_on_crease && !state_.sizes.binding() ? normal_.dot(quadric_.times(normal_)) : 0;
    is_curved_ = steepness_ > 0 && quadric_.trace() > (1 + kLeastBend) * steepness_;
    error_limit_ = mean_error_limit(quadric_, limits_.tolerance * limits_.tolerance);
    size_limit_ = std::max(limits_.max_size, shape_.size_max);
    stretch_limit_ = shape_.stretch_min >= limits_.bounds.min_stretch ? limits_.bounds.min_stretch : 0;
    if (limits_.bounds.shaped()) excess_before_ = star_.excess(limits_.bounds, mesh_.position(v));
    return true;
}

/// The place nearest to `wanted`, relative to the centre, that is as near to the planes gathered as a vertex gets. Where the
/// surface is smooth that is along its normal: all directions of a curved one count as directions across, and the minimum of
/// its quadric would hold the vertex where it is.
Vec3 VertexMover::onto_surface(const Vec3& wanted) const {
    if (!(steepness_ > 0)) return project_to_minimum(quadric_, wanted);
    return wanted - normal_ * (normal_.dot(quadric_.half_gradient(wanted)) / steepness_);
}

/// `wanted`, or of it what lies along the boundary where the star is open.
Vec3 VertexMover::along_boundary(const Vec3& here, const Vec3& wanted) const {
    if (!star_.is_open()) return wanted;
    const Vec3 way = star_.ring(0) - star_.ring(star_.size());
    const double square = way.squaredNorm();
    return square > 0 ? Vec3(here + (wanted - here).dot(way) / square * way) : here;
}

/// Where each face would be equilateral over its ring edge, in the mean.
Vec3 VertexMover::ideal() const {
    Vec3 sum = Vec3::Zero();
    for (std::size_t t = 0; t < star_.size(); ++t) {
        const Vec3 a = star_.ring(t);
        const Vec3 b = star_.ring(t + 1);
        sum += (a + b) / 2 + star_.old_normal(t).cross(b - a) * kEquilateralHeight;
    }
    return sum / static_cast<double>(star_.size());
}

/// Whether the vertex may stand at `place`, relative to the centre; the star is then shaped for it.
bool VertexMover::admits(const Vec3& place) {
    if (!(quadric_.error(place) <= error_limit_) || !is_valid_position(place + limits_.centre)) return false;
    shape_ = star_.shape_at(place + limits_.centre);
    return !shape_.folds && shape_.size_max <= size_limit_ && keeps_bounds(place + limits_.centre) &&
           sizes_admit(place + limits_.centre);
}

bool VertexMover::keeps_bounds(const Vec3& position) const {
    if (!limits_.bounds.shaped()) return shape_.stretch_min >= stretch_limit_;
    return star_.excess(limits_.bounds, position).may_follow(excess_before_);
}

/// Whether no edge gets longer than its ends allow, or stays so.
bool VertexMover::sizes_admit(const Vec3& position) const {
    if (!state_.sizes.binding()) return true;
    const double allowed = state_.sizes.around(mesh_, vertex_, position);
    for (std::size_t t = 0; t < star_.ring_size(); ++t) {
        const double before = (star_.ring(t) - mesh_.position(vertex_)).norm();
        if (star_.spoke(t) > before && !VertexSizes::fits(star_.spoke(t), allowed, state_.sizes.allowed(star_.vertex(t))))
            return false;
    }
    return true;
}

bool VertexMover::put(std::uint32_t v, const Vec3& place) {
    static_cast<void>(star_.shape_at(place + limits_.centre));
    if (!creases_.try_move(star_, place + limits_.centre)) return false;
    if (guard_ != nullptr && !replacement_.try_on(*guard_, star_, place + limits_.centre, {}, {v, kNone})) return false;
    log_.record_move(mesh_, v);
    if (state_.sizes.given()) state_.sizes.put(v, state_.sizes.around(mesh_, v, place + limits_.centre));
    mesh_.move(v, place + limits_.centre);
    creases_.commit();
    for (std::size_t t = 0; t < star_.size(); ++t) {
        const std::uint32_t after = star_.vertex(t + 1 < star_.ring_size() ? t + 1 : 0);
        state_.faces[star_.face(t)] = {star_.normal(t), star_.stretch(t),
                                       state_.sizes.relative(star_.face_size(t), v, star_.vertex(t), after)};
    }
    return true;
}

void VertexMover::relax(std::uint32_t v, Moves moves) {
    if (!gather_star(v)) return;
    const Vec3 here = mesh_.position(v) - limits_.centre;
    const Vec3 target = ideal() - limits_.centre;
    double least = star_.defect() - (moves == Moves::kWorthwhile && is_curved_ ? kLeastGainOnCurves : kLeastGain);
    Vec3 best = here;
    for (const Vec3& wanted : {target, Vec3(star_.centroid() - limits_.centre), Vec3((target + here) / 2)}) {
        const Vec3 place = onto_surface(along_boundary(here, wanted));
        if (!admits(place) || !(star_.defect() < least)) continue;
        least = star_.defect();
        best = place;
    }
    if (best != here) static_cast<void>(put(v, best));
}

void VertexMover::lift(std::uint32_t v, double goal) {
    if (!gather_star(v) || shape_.stretch_min >= goal) return;
    static_cast<void>(search(
        v, [this](const Vec3&) { return shape_.stretch_min; }, 1));
}

bool VertexMover::mend(std::uint32_t v) {
    if (!gather_star(v)) return false;
    const auto kept = [this](const Vec3& position) { return -star_.excess(limits_.bounds, position).sum; };
    return kept(mesh_.position(v)) < 0 && search(v, kept, 0);
}

template <class Value>
bool VertexMover::search(std::uint32_t v, Value value_at, double goal) {
    const Vec3 u = normal_.unitOrthogonal();
    const Vec3 w = normal_.cross(u);
    const Vec3 here = mesh_.position(v) - limits_.centre;
    Vec3 best = here;
    double most = value_at(mesh_.position(v));
    double step = kFirstStep * shape_.size_max;
    for (int halving = 0; halving < kHalvings;) {
        bool better = false;
        for (const auto& [x, y] : kPattern) {
            const Vec3 place = onto_surface(along_boundary(best, best + step * (x * u + y * w)));
            if (!admits(place)) continue;
            const double value = value_at(place + limits_.centre);
            if (!(value > most + kLeastGain || (value >= goal && most < goal))) continue;
            most = value;
            best = place;
            better = true;
        }
        if (better) continue;
        step /= 2;
        ++halving;
    }
    return best != here && put(v, best);
}

}  // namespace vsplit

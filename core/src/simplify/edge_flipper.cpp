#include "simplify/edge_flipper.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "quality/face_shape.h"

namespace vsplit {
namespace {

/// Faces of a better shape are left alone.
constexpr double kGoodEnough = 0.95;
/// Of the angle between a face before the flip and one after it: 26 degrees.
constexpr double kLeastNormalCosine = 0.9;

/// A face that a flip would make.
struct NewFace {
    Vec3 normal = Vec3::Zero();  // not unit while degenerate
    double stretch = 0;
    double size = 0;

    NewFace(const Vec3& a, const Vec3& b, const Vec3& c) {
        const Vec3 cross = (b - a).cross(c - a);
        const double twice_area = cross.norm();
        const double ab = (b - a).norm(), bc = (c - b).norm(), ca = (a - c).norm();
        stretch = stretch_of(ab, bc, ca, twice_area);
        size = std::max({ab, bc, ca});
        normal = twice_area > 0 ? Vec3(cross / twice_area) : cross;
    }

    [[nodiscard]] FaceState state(double relative_size) const { return {normal.cast<float>(), stretch, relative_size}; }
};

}  // namespace

/// The faces (a, b, c) of h and (b, a, d) of its twin, which would become (d, c, a) and (c, d, b).
struct EdgeFlipper::Quad {
    FaceState of_h, of_twin;
    std::uint32_t a, b, c, d;
    Vec3 pa, pb, pc, pd;
    NewFace left, right;

    Quad(const HalfEdgeMesh& mesh, const LocalState& state, HalfEdge h)
        : of_h(state.faces[face_of(h)]),
          of_twin(state.faces[face_of(mesh.twin(h))]),
          a(mesh.origin(h)),
          b(mesh.target(h)),
          c(mesh.origin(prev(h))),
          d(mesh.origin(prev(mesh.twin(h)))),
          pa(mesh.position(a)),
          pb(mesh.position(b)),
          pc(mesh.position(c)),
          pd(mesh.position(d)),
          left(pd, pc, pa),
          right(pc, pd, pb) {}

    [[nodiscard]] double gain() const { return std::min(left.stretch, right.stretch) - std::min(of_h.stretch, of_twin.stretch); }

    /// Neither new face turns away from either old one.
    [[nodiscard]] bool normals_stay() const {
        const Vec3 n_h = of_h.normal.cast<double>();
        const Vec3 n_twin = of_twin.normal.cast<double>();
        return std::min({left.normal.dot(n_h), left.normal.dot(n_twin), right.normal.dot(n_h), right.normal.dot(n_twin)}) >=
               kLeastNormalCosine;
    }

    /// Whether the two diagonals pass each other within `gap`: what the flip moves the surface by.
    [[nodiscard]] bool moves_surface_within(double gap) const {
        const Vec3 across = (pb - pa).cross(pd - pc);
        return std::abs(across.dot(pc - pa)) <= gap * across.norm();
    }
};

bool EdgeFlipper::has_edge(std::uint32_t from, std::uint32_t to) const {
    bool found = false;
    mesh_.for_each_outgoing(from, [&](HalfEdge h) { found |= mesh_.target(h) == to; });
    return found;
}

bool EdgeFlipper::may_flip(const Quad& quad) const {
    if (mesh_.valence(quad.a) <= 3 || mesh_.valence(quad.b) <= 3) return false;
    if (std::max(mesh_.valence(quad.c), mesh_.valence(quad.d)) >= limits_.max_valence) return false;
    const double length = (quad.pd - quad.pc).norm();
    if (!(quad.gain() > kLeastGain) || length > limits_.max_size || !state_.sizes.admits(length, quad.c, quad.d)) return false;
    return quad.normals_stay() && quad.moves_surface_within(limits_.tolerance) && !has_edge(quad.c, quad.d);
}

bool EdgeFlipper::guard_admits(const Quad& quad, HalfEdge h) {
    if (guard_ == nullptr) return true;
    const std::uint32_t left = face_of(h), right = face_of(mesh_.twin(h));
    // The side (c, a) of the new left face was of the face of h, the side (d, b) of the right one of its twin's.
    const std::array<DeviationGuard::NewFace, 2> faces{{{left, quad.pd, quad.pc, quad.pa, quad.of_h.normal.cast<double>()},
                                                        {right, quad.pc, quad.pd, quad.pb, quad.of_twin.normal.cast<double>()}}};
    return guard_->replace(std::array{left, right}, faces);
}

bool EdgeFlipper::is_beside_ghost(HalfEdge h) const {
    if (state_.border.empty()) return false;
    const HalfEdge g = mesh_.twin(h);
    const std::uint32_t least = std::min({mesh_.origin(h), mesh_.origin(g), mesh_.origin(prev(h)), mesh_.origin(prev(g))});
    return state_.border.is_ghost(least);
}

bool EdgeFlipper::flip_if_better(HalfEdge h) {
    const HalfEdge g = mesh_.twin(h);
    if (mesh_.is_crease(h) || is_beside_ghost(h)) return false;
    if (std::min(state_.faces[face_of(h)].stretch, state_.faces[face_of(g)].stretch) > kGoodEnough) return false;
    const Quad quad(mesh_, state_, h);
    if (!may_flip(quad) || !creases_.try_flip(h, quad.left.normal, quad.right.normal) || !guard_admits(quad, h)) return false;
    log_.record_flip(h);
    mesh_.flip(h);
    creases_.commit();
    state_.faces[face_of(h)] = quad.left.state(state_.sizes.relative(quad.left.size, quad.d, quad.c, quad.a));
    state_.faces[face_of(g)] = quad.right.state(state_.sizes.relative(quad.right.size, quad.c, quad.d, quad.b));
    return true;
}

void EdgeFlipper::flip_open_edges() {
    while (!open_.empty()) {
        const HalfEdge h = open_.back();
        open_.pop_back();
        if (!flip_if_better(h)) continue;
        const HalfEdge g = mesh_.twin(h);
        for (const HalfEdge side : {next(h), prev(h), next(g), prev(g)}) open_.push_back(side);
        changed_.push_back(face_of(h));
        changed_.push_back(face_of(g));
    }
}

void EdgeFlipper::flip_all() {
    open_.clear();
    for (HalfEdge h = mesh_.half_edge_count(); h-- > 0;) {
        if (!mesh_.removed(h) && mesh_.edge_of(h) == h) open_.push_back(h);
    }
    flip_open_edges();
    changed_.clear();
}

void EdgeFlipper::flip_around(std::uint32_t v) {
    changed_.clear();
    open_.clear();
    mesh_.for_each_outgoing(v, [this](HalfEdge h) {
        open_.push_back(next(h));
        open_.push_back(h);
    });
    flip_open_edges();
}

}  // namespace vsplit

#include "simplify/crease_replacement.h"

#include <algorithm>

namespace vsplit {
namespace {

/// Creases do not turn to blades: where the normals on either side come near to opposite, a later step folds the surface.
constexpr float kBlade = -0.8F;
constexpr float kBladeStep = 0.05F;

/// Of the normals on either side of spoke t.
float dot_at_spoke(const Fan& fan, std::size_t t) { return fan.normal(t).dot(fan.normal(t == 0 ? fan.size() - 1 : t - 1)); }

}  // namespace

void CreaseReplacement::start() {
    old_.clear();
    new_.clear();
    makes_blade_ = false;
}

void CreaseReplacement::take(HalfEdge h) {
    if (mesh_.is_crease(h)) old_.push_back(mesh_.edge_of(h));
}

/// Of the normals on either side of h as it is.
float CreaseReplacement::dot_at(HalfEdge h) const {
    return state_.faces[face_of(h)].normal.dot(state_.faces[face_of(mesh_.twin(h))].normal);
}

void CreaseReplacement::offer(HalfEdge edge, bool kept_flat, Dots dots, const Vec3& a, const Vec3& b) {
    makes_blade_ |= dots.after < std::min(kBlade, dots.before - kBladeStep);
    if (kept_flat || dots.after < cosine_) new_.push_back({edge, a, b});
}

void CreaseReplacement::add_spoke(HalfEdge spoke, const Fan& fan, std::size_t t, const Vec3& apex) {
    if (!mesh_.is_crease(spoke)) return;
    take(spoke);
    offer(mesh_.edge_of(spoke), mesh_.is_kept_flat(spoke), {dot_at(spoke), dot_at_spoke(fan, t)}, apex, fan.ring(t));
}

/// Two spokes that a collapse makes one of, which will go by the number `edge`.
void CreaseReplacement::add_wing(HalfEdge one, HalfEdge other, HalfEdge edge, const Fan& fan, std::size_t t, const Vec3& apex) {
    take(one);
    take(other);
    if (!mesh_.is_crease(one) && !mesh_.is_crease(other)) return;
    const float before = std::min(dot_at(one), dot_at(other));
    offer(edge, mesh_.is_kept_flat(one) || mesh_.is_kept_flat(other), {before, dot_at_spoke(fan, t)}, apex, fan.ring(t));
}

void CreaseReplacement::add_side(HalfEdge side, const Fan& fan, std::size_t t) {
    if (!mesh_.is_crease(side)) return;
    take(side);
    const float dot = fan.normal(t).dot(state_.faces[face_of(mesh_.twin(side))].normal);
    offer(mesh_.edge_of(side), mesh_.is_kept_flat(side), {dot_at(side), dot}, fan.ring(t), fan.ring(t + 1));
}

void CreaseReplacement::commit() {
    if (!old_.empty()) guard_->commit(old_);
}

bool CreaseReplacement::try_collapse(const EdgeStar& star, const Fan& fan, const Vec3& apex) {
    if (guard_ == nullptr) return true;
    start();
    take(star.ij);
    std::size_t t = 0;
    const auto walk = [&](HalfEdge first, HalfEdge twin_of_first, HalfEdge partner, std::uint32_t last_face) {
        for (HalfEdge spoke = first; face_of(spoke) != last_face; spoke = mesh_.turn(spoke), ++t) {
            if (spoke == first) {
                add_wing(first, partner, std::min(first, twin_of_first), fan, t, apex);
            } else {
                add_spoke(spoke, fan, t, apex);
            }
            add_side(next(spoke), fan, t);
        }
    };
    walk(star.ie, star.ej, star.je, face_of(star.ji));
    walk(star.jb, star.bi, star.ib, face_of(star.ij));
    return done();
}

bool CreaseReplacement::try_move(std::uint32_t v, const Fan& fan, const Vec3& apex) {
    if (guard_ == nullptr) return true;
    start();
    std::size_t t = 0;
    mesh_.for_each_outgoing(v, [&](HalfEdge spoke) {
        add_spoke(spoke, fan, t, apex);
        add_side(next(spoke), fan, t++);
    });
    return done();
}

bool CreaseReplacement::try_flip(HalfEdge h, const Vec3& of_h, const Vec3& of_twin) {
    if (guard_ == nullptr) return true;
    start();
    const HalfEdge g = mesh_.twin(h);
    // Each side goes over to the half-edge that the flip puts in its place; see HalfEdgeMesh::flip.
    const auto add = [&](HalfEdge side, HalfEdge becomes, const Vec3& normal) {
        if (!mesh_.is_crease(side)) return;
        take(side);
        const HalfEdge outside = mesh_.twin(side);
        const float dot = normal.cast<float>().dot(state_.faces[face_of(outside)].normal);
        offer(std::min(becomes, outside), mesh_.is_kept_flat(side), {dot_at(side), dot}, mesh_.position(mesh_.origin(side)),
              mesh_.position(mesh_.target(side)));
    };
    add(prev(h), next(h), of_h);
    add(next(g), prev(h), of_h);
    add(prev(g), next(g), of_twin);
    add(next(h), prev(g), of_twin);
    return done();
}

}  // namespace vsplit

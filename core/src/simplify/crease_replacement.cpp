#include "simplify/crease_replacement.h"

#include <algorithm>
#include <iterator>

namespace vsplit {
namespace {

/// Creases do not turn to blades: where the normals on either side come near to opposite, a later step folds the surface.
constexpr float kBlade = -0.8F;
constexpr float kBladeStep = 0.05F;

/// Of the normals on either side of the spoke to ring vertex t; 0 along a boundary, where there is but one.
float dot_at_spoke(const Fan& fan, std::size_t t) {
    const bool ends_fan = fan.is_open() && (t == 0 || t == fan.size());
    return ends_fan ? 0 : fan.normal(t).dot(fan.normal(t == 0 ? fan.size() - 1 : t - 1));
}

}  // namespace

void CreaseReplacement::start() {
    old_.clear();
    new_.clear();
    unmarked_.clear();
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

void CreaseReplacement::offer_unmarked(HalfEdge edge, float dot, const Vec3& a, const Vec3& b) {
    if (!may_flatten_ || !(dot < cosine_)) return;
    new_.push_back({edge, a, b});
    unmarked_.push_back(edge);
}

/// Spoke h, or its twin, to ring vertex t.
void CreaseReplacement::add_spoke(HalfEdge h, const Fan& fan, std::size_t t, const Vec3& apex) {
    if (!mesh_.is_crease(h)) return offer_unmarked(mesh_.edge_of(h), dot_at_spoke(fan, t), apex, fan.ring(t));
    take(h);
    offer(mesh_.edge_of(h), mesh_.is_kept_flat(h), {dot_at(h), dot_at_spoke(fan, t)}, apex, fan.ring(t));
}

/// The spoke to ring vertex t that two edges, those of `one` and `other`, become one of.
void CreaseReplacement::add_wing(HalfEdge one, HalfEdge other, const Fan& fan, std::size_t t, const Vec3& apex) {
    if (!mesh_.is_crease(one) && !mesh_.is_crease(other))
        return offer_unmarked(std::min(one, other), dot_at_spoke(fan, t), apex, fan.ring(t));
    take(one);
    take(other);
    const bool kept_flat = mesh_.is_kept_flat(one) || mesh_.is_kept_flat(other);
    offer(std::min(one, other), kept_flat, {std::min(dot_at(one), dot_at(other)), dot_at_spoke(fan, t)}, apex, fan.ring(t));
}

void CreaseReplacement::add_side(HalfEdge side, const Fan& fan, std::size_t t) {
    if (!mesh_.is_crease(side)) {
        return offer_unmarked(mesh_.edge_of(side), fan.normal(t).dot(state_.faces[face_of(mesh_.twin(side))].normal), fan.ring(t),
                              fan.ring(t + 1));
    }
    take(side);
    const float after = fan.normal(t).dot(state_.faces[face_of(mesh_.twin(side))].normal);
    offer(mesh_.edge_of(side), mesh_.is_kept_flat(side), {dot_at(side), after}, fan.ring(t), fan.ring(t + 1));
}

/// The half-edge of the fan's face t that lies on its ring.
HalfEdge CreaseReplacement::side_of(const Fan& fan, std::size_t t) const {
    HalfEdge side = 3 * fan.face(t);
    while (mesh_.origin(side) != fan.vertex(t)) side = next(side);
    return side;
}

template <class AddSpoke>
bool CreaseReplacement::try_fan(const Fan& fan, AddSpoke add) {
    for (std::size_t t = 0; t < fan.size(); ++t) {
        const HalfEdge side = side_of(fan, t);
        add(prev(side), t);
        add_side(side, fan, t);
    }
    if (fan.is_open()) add(next(side_of(fan, fan.size() - 1)), fan.size());
    return admitted();
}

void CreaseReplacement::commit() {
    new_marks_.clear();
    if (old_.empty()) return;
    guard_->commit(old_);
    std::copy_if(unmarked_.begin(), unmarked_.end(), std::back_inserter(new_marks_),
                 [this](HalfEdge edge) { return guard_->holds_points(edge); });
}

bool CreaseReplacement::try_collapse(const EdgeStar& star, const Fan& fan, const Vec3& apex) {
    if (guard_ == nullptr) return true;
    start();
    take(star.ij);
    return try_fan(fan, [&](HalfEdge spoke, std::size_t t) {
        if (spoke == star.ie || spoke == star.ej) {
            add_wing(star.ie, star.ej, fan, t, apex);
        } else if (spoke == star.jb || spoke == star.bi) {
            add_wing(star.jb, star.bi, fan, t, apex);
        } else {
            add_spoke(spoke, fan, t, apex);
        }
    });
}

bool CreaseReplacement::try_move(const Fan& fan, const Vec3& apex) {
    if (guard_ == nullptr) return true;
    start();
    return try_fan(fan, [&](HalfEdge spoke, std::size_t t) { add_spoke(spoke, fan, t, apex); });
}

bool CreaseReplacement::try_flip(HalfEdge h, const Vec3& of_h, const Vec3& of_twin) {
    if (guard_ == nullptr) return true;
    start();
    const HalfEdge g = mesh_.twin(h);
    take(h);  // one that has gone flat
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
    return admitted();
}

}  // namespace vsplit

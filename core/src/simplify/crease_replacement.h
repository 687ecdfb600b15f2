#pragma once

#include <cmath>
#include <vector>

#include "simplify/crease_guard.h"
#include "simplify/fan.h"
#include "simplify/half_edge_mesh.h"
#include "simplify/local_state.h"

namespace vsplit {

/// What a collapse, a move or a flip makes of the creases about, for a CreaseGuard; owns the scratch memory. A crease
/// counts while the normals of its faces differ by more than an angle, or where it is one without that; see HalfEdgeMesh.
class CreaseReplacement {
public:
    /// `cosine`: of the angle.
    CreaseReplacement(const HalfEdgeMesh& mesh, const LocalState& state, CreaseGuard* guard, double cosine)
        : mesh_(mesh), state_(state), guard_(guard), angle_cosine_(cosine), cosine_(static_cast<float>(cosine)) {}

    /// From now on creases count while the normals differ by more than half of the angle: what a result is judged by. Or again by
    /// the whole, so that there is room for the steps that follow.
    void let_flatten(bool to_half) {
        may_flatten_ = to_half;
        cosine_ = static_cast<float>(to_half ? std::sqrt((1 + angle_cosine_) / 2) : angle_cosine_);
    }

    /// Whether the guard lets the edge of `star` collapse. \pre `fan` is that of the collapse, shaped for `apex`.
    [[nodiscard]] bool try_collapse(const EdgeStar& star, const Fan& fan, const Vec3& apex);

    /// Whether the guard lets a vertex move. \pre `fan` is the faces around it, shaped for `apex`.
    [[nodiscard]] bool try_move(const Fan& fan, const Vec3& apex);

    /// Whether the guard lets the edge of h turn into faces with these normals: that of h and that of its twin.
    [[nodiscard]] bool try_flip(HalfEdge h, const Vec3& of_h, const Vec3& of_twin);

    /// What the last try found holds from now on. \pre it said yes.
    void commit();

    /// The edges that were no creases and took points at the last commit, as they may where creases may go flat.
    [[nodiscard]] const std::vector<HalfEdge>& new_creases() const { return new_marks_; }

private:
    /// Of the normals on either side of an edge.
    struct Dots {
        float before = 0;
        float after = 0;
    };

    void start();
    void take(HalfEdge h);
    [[nodiscard]] float dot_at(HalfEdge h) const;
    void offer_unmarked(HalfEdge edge, float dot, const Vec3& a, const Vec3& b);
    void offer(HalfEdge edge, bool kept_flat, Dots dots, const Vec3& a, const Vec3& b);
    void add_spoke(HalfEdge h, const Fan& fan, std::size_t t, const Vec3& apex);
    void add_wing(HalfEdge one, HalfEdge other, const Fan& fan, std::size_t t, const Vec3& apex);
    void add_side(HalfEdge side, const Fan& fan, std::size_t t);
    [[nodiscard]] HalfEdge side_of(const Fan& fan, std::size_t t) const;
    template <class AddSpoke>
    [[nodiscard]] bool try_fan(const Fan& fan, AddSpoke add);
    [[nodiscard]] bool admitted() const { return old_.empty() || (!makes_blade_ && guard_->admits(old_, new_)); }

    const HalfEdgeMesh& mesh_;
    const LocalState& state_;
    CreaseGuard* const guard_;
    const double angle_cosine_;
    bool may_flatten_ = false;
    float cosine_;  // of the angle that counts
    std::vector<HalfEdge> old_;
    std::vector<CreaseGuard::NewCrease> new_;
    std::vector<HalfEdge> unmarked_, new_marks_;
    bool makes_blade_ = false;
};

}  // namespace vsplit

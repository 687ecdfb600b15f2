#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "simplify/fan.h"
#include "simplify/half_edge_mesh.h"
#include "simplify/local_state.h"
#include "simplify/placement.h"
#include "simplify/policies.h"

namespace vsplit {

/// No collapse makes a vertex of more edges: around one, faces get a stretch under 0.17 on average, below what any solver takes.
/// It also keeps an evaluation from costing more than this many faces on fans of thousands of slivers.
inline constexpr std::uint32_t kValenceCeiling = 64;

/// What the collapse of an edge would be.
struct Evaluation {
    enum class Verdict {
        kValid,
        kInvalid,       ///< until the neighbourhood changes
        kOutOfReach,    ///< no place is within tolerance: until one of the two ends changes
    };
    Verdict verdict = Verdict::kInvalid;
    double priority = 0;
    Vec3 position = Vec3::Zero();
};

/// Evaluates edges for one thread: owns the scratch memory, reads everything else.
template <class Policy>
class EdgeEvaluator {
public:
    EdgeEvaluator(const HalfEdgeMesh& mesh, const LocalState& state, const Policy& policy, const SimplifyInput& input)
        : mesh_(mesh), state_(state), policy_(policy), centre_(input.centre), error_limit_(input.tolerance * input.tolerance) {}

    /// The faces around both ends of h's edge. O(1).
    [[nodiscard]] Before before(HalfEdge h) const {
        const HalfEdge g = mesh_.twin(h);
        const std::uint32_t i = mesh_.origin(h);
        const std::uint32_t j = mesh_.origin(g);
        const FaceState& left = state_.faces[face_of(h)];
        const FaceState& right = state_.faces[face_of(g)];
        const VertexState& at_i = state_.vertices[i];
        const VertexState& at_j = state_.vertices[j];
        // The two faces at the edge are in both sums.
        return {static_cast<double>(mesh_.valence(i) + mesh_.valence(j) - 2),
                std::max(0.0, at_i.stretch_sum + at_j.stretch_sum - left.stretch - right.stretch),
                std::min(at_i.stretch_min, at_j.stretch_min),
                std::max(0.0, at_i.weight_sum + at_j.weight_sum - policy_.face_weight(left.size) - policy_.face_weight(right.size))};
    }

    /// No priority of this edge can be larger; negative when it cannot be collapsed whatever its faces. O(1).
    [[nodiscard]] double bound(HalfEdge h) const {
        const std::uint32_t valence = mesh_.valence(mesh_.origin(h)) + mesh_.valence(mesh_.target(h)) - 4;
        if (valence < 3 || valence > kValenceCeiling || !policy_.admits_valence(valence)) return -1;
        const Before faces = before(h);
        return policy_.eligible(faces) ? policy_.bound(faces) : -1;
    }

    /// O(valence). Afterwards fan() is the fan of the collapse, shaped for the position returned, when valid.
    [[nodiscard]] Evaluation evaluate(HalfEdge h, double bound) {
        const Before faces = before(h);
        if (!gather(h)) return {};
        const Quadric quadric = state_.quadrics[mesh_.origin(h)] + state_.quadrics[mesh_.target(h)];
        bool reachable = false;
        const auto attempt = [&](const Vec3& place) -> std::optional<Evaluation> {
            if (quadric.error(place - centre_) > error_limit_) return std::nullopt;
            reachable = true;
            const Fan::Shape shape = fan_.shape_at(place);
            if (shape.folds || !policy_.admits(faces, shape)) return std::nullopt;
            return Evaluation{Evaluation::Verdict::kValid, bound * shape_quality(shape, fan_.size()), place};
        };
        const Vec3 centroid = fan_.centroid();
        if (auto valid = attempt(centroid)) return *valid;
        if (auto valid = attempt(project_to_minimum(quadric, centroid - centre_) + centre_)) return *valid;
        const Vec3 middle = (mesh_.position(mesh_.origin(h)) + mesh_.position(mesh_.target(h))) * 0.5;
        if (auto valid = attempt(project_to_minimum(quadric, middle - centre_) + centre_)) return *valid;
        if (auto valid = attempt(mesh_.position(mesh_.origin(h)))) return *valid;
        if (auto valid = attempt(mesh_.position(mesh_.target(h)))) return *valid;
        const std::optional<Vec3> best = minimum(quadric);
        if (!best) return {};
        if (auto valid = attempt(*best + centre_)) return *valid;
        // At a well-conditioned minimum the error is least; where even that is too much, every place is.
        const bool out_of_reach = !reachable && quadric.error(*best) > error_limit_;
        return {out_of_reach ? Evaluation::Verdict::kOutOfReach : Evaluation::Verdict::kInvalid};
    }

    [[nodiscard]] const Fan& fan() const { return fan_; }

private:
    /// Walks the ring of the edge into the fan. False when the link condition fails: the ends share a neighbour besides the two
    /// across the edge, so that the collapse would pinch the surface.
    [[nodiscard]] bool gather(HalfEdge h) {
        const HalfEdge g = mesh_.twin(h);
        const std::uint32_t i = mesh_.origin(h);
        const std::uint32_t j = mesh_.origin(g);
        if (mesh_.valence(i) == 3 && mesh_.valence(j) == 3) return false;  // a tetrahedron
        fan_.reset(mesh_.valence(i) + mesh_.valence(j));
        const std::size_t at_i = gather_half(mesh_.turn(h), g);
        const std::size_t at_j = gather_half(mesh_.turn(g), h) - at_i;
        // Each half begins with a vertex across the edge, which both ends share; the others must differ.
        if (share_vertex(fan_.vertex.data() + 1, at_i - 1, fan_.vertex.data() + at_i + 1, at_j - 1)) return false;
        fan_.close();
        return true;
    }

    /// Adds the faces counter-clockwise from that of `first` to the one before the face of `edge`'s twin. Faces in the fan so far.
    std::size_t gather_half(HalfEdge first, HalfEdge edge) {
        const std::uint32_t last_face = face_of(edge);
        for (HalfEdge corner = first; face_of(corner) != last_face; corner = mesh_.turn(corner)) {
            const std::uint32_t v = mesh_.target(corner);
            fan_.add(v, mesh_.position(v), face_of(corner), state_.faces[face_of(corner)].normal);
        }
        return fan_.size();
    }

    [[nodiscard]] bool share_vertex(const std::uint32_t* left, std::size_t left_count, const std::uint32_t* right, std::size_t right_count) {
        constexpr std::size_t kBruteForce = 1024;
        if (left_count * right_count <= kBruteForce) {
            bool shared = false;
            for (std::size_t l = 0; l < left_count; ++l) {
                for (std::size_t r = 0; r < right_count; ++r) shared |= left[l] == right[r];
            }
            return shared;
        }
        sorted_.assign(left, left + left_count);
        std::sort(sorted_.begin(), sorted_.end());
        return std::any_of(right, right + right_count, [&](std::uint32_t v) { return std::binary_search(sorted_.begin(), sorted_.end(), v); });
    }

    const HalfEdgeMesh& mesh_;
    const LocalState& state_;
    const Policy& policy_;
    const Vec3 centre_;
    const double error_limit_;
    Fan fan_;
    std::vector<std::uint32_t> sorted_;
};

}  // namespace vsplit

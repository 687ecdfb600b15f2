#include "method/flip_slivers.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <utility>
#include <vector>

#include "mesh/cap_boundaries.h"
#include "method/editable_mesh.h"
#include "simplify/flip_quad.h"
#include "vsplit/features/face_normals.h"

namespace vsplit {
namespace {

constexpr std::uint32_t kLookEvery = 4096;
/// Flips end by themselves on a plane; rounding and the gap must not make them go round.
constexpr std::size_t kMostFlipsAFace = 64;

/// Works on a closed mesh whose first vertices may be ghosts.
class SliverFlipper {
public:
    SliverFlipper(const CappedMesh& capped, const std::vector<SharpEdge>& creases, FaceNormals normals, double gap)
        : mesh_(capped.mesh, creases), normals_(std::move(normals.normals)), ghosts_(capped.ghosts), gap_(gap) {
        normals_.resize(capped.mesh.faces.size(), Vec3::Zero());
        moved_.resize(capped.mesh.faces.size(), 0);
    }

    /// Whether any edge was flipped.
    bool flip_all(const ExecutionContext& context) {
        const auto all = static_cast<HalfEdge>(3 * mesh_.mesh().faces.size());
        for (HalfEdge h = all; h-- > 0;) {
            if (h < mesh_.twin(h)) open_.push_back(h);
        }
        std::size_t flips = 0;
        for (std::size_t looks = 0; !open_.empty() && flips < kMostFlipsAFace * all / 3; ++looks) {
            if (looks % kLookEvery == 0 && context.cancelled()) break;
            const HalfEdge h = open_.back();
            open_.pop_back();
            flips += flip_if_better(h) ? 1 : 0;
        }
        return flips > 0;
    }

    [[nodiscard]] const EditableMesh& mesh() const { return mesh_; }

    /// How far the surface has moved at most: each flip moves that of its two faces by the gap between the diagonals.
    [[nodiscard]] double moved() const { return *std::max_element(moved_.begin(), moved_.end()); }

private:
    bool flip_if_better(HalfEdge h) {
        const HalfEdge g = mesh_.twin(h);
        const std::uint32_t a = mesh_.origin(h), b = mesh_.origin(g), c = mesh_.origin(prev(h)), d = mesh_.origin(prev(g));
        if (mesh_.is_crease(h) || std::min({a, b, c, d}) < ghosts_) return false;
        if (mesh_.valence(a) <= 3 || mesh_.valence(b) <= 3) return false;
        if (!is_within_circle(mesh_.position(a), mesh_.position(b), mesh_.position(c), mesh_.position(d))) return false;
        const FlipQuad q(mesh_.position(a), mesh_.position(b), mesh_.position(c), mesh_.position(d), normals_[face_of(h)],
                         normals_[face_of(g)]);
        const double moved = std::max(moved_[face_of(h)], moved_[face_of(g)]) + q.gap();
        if (!q.normals_stay() || !(moved <= gap_) || mesh_.has_edge(c, d)) return false;
        moved_[face_of(h)] = moved_[face_of(g)] = moved;
        mesh_.turn(h);
        normals_[face_of(h)] = q.left.normal;
        normals_[face_of(g)] = q.right.normal;
        for (const HalfEdge side : {next(h), prev(h), next(g), prev(g)}) open_.push_back(side);
        return true;
    }

    EditableMesh mesh_;
    std::vector<Vec3> normals_;  // of the faces; anything for those at ghosts
    std::vector<double> moved_;  // of the faces
    const std::uint32_t ghosts_;
    const double gap_;
    std::vector<HalfEdge> open_;  // edges to look at, last first
};

}  // namespace

std::shared_ptr<const CreasedMesh> flip_slivers(const TriangleMesh& mesh, const FeatureOptions& features, double gap,
                                                const ExecutionContext& context) {
    FaceNormals normals = face_normals(mesh);
    std::vector<SharpEdge> creases = find_creases(mesh, normals, features);
    const CappedMesh capped = cap_manifold(mesh);
    SliverFlipper flipper(capped, with_ghosts(creases, capped.ghosts), std::move(normals), gap);
    if (!flipper.flip_all(context)) return nullptr;
    return std::make_shared<const CreasedMesh>(
        CreasedMesh{visible_mesh(flipper.mesh().mesh(), capped.ghosts), std::move(creases), flipper.moved()});
}

}  // namespace vsplit

#include "simplify/deviation_guard.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>

#include "simplify/edge_evaluator.h"
#include "simplify/edge_flipper.h"
#include "simplify/fan_replacement.h"
#include "simplify/vertex_mover.h"
#include "tests/core/meshes.h"
#include "tests/core/polishing.h"
#include "tests/core/random.h"

namespace vsplit::test {
namespace {

/// Collapses, flips and moves in a random order, each that is valid and that the guard, where there is one, lets pass.
class GuardedEditor {
public:
    GuardedEditor(const TriangleMesh& source, double tolerance_share, std::optional<double> limit, std::uint64_t seed)
        : p(source, tolerance_share),
          random_(seed),
          index_(surface_index(source)),
          evaluator_(p.mesh, p.state, policy_, p.input) {
        if (limit) guard_.emplace(p.mesh, index_, *limit);
    }

    void edit(std::uint32_t faces_min, int tries) {
        DeviationGuard* guard = guard_ ? &*guard_ : nullptr;
        EdgeFlipper flipper(p.mesh, p.state, p.log, {guard, nullptr}, p.limits());
        VertexMover mover(p.mesh, p.state, p.log, {guard, nullptr}, p.limits());
        for (int n = 0; n < tries && p.mesh.live_faces() > faces_min; ++n) {
            const HalfEdge h = random_.below(p.mesh.half_edge_count());
            if (p.mesh.removed(h)) continue;
            switch (random_.below(8)) {
                case 0:
                    mover.relax(p.mesh.origin(h));
                    break;
                case 1:
                    mover.lift(p.mesh.origin(h), 0.8);
                    break;
                case 2:
                    flipper.flip_around(p.mesh.origin(h));
                    break;
                default:
                    collapse(h);
            }
        }
    }

    [[nodiscard]] int collapses() const { return collapses_; }
    [[nodiscard]] int refused() const { return refused_; }

    Polishing p;

private:
    void collapse(HalfEdge h) {
        const HalfEdge edge = p.mesh.edge_of(h);
        const Evaluation evaluation = evaluator_.evaluate(edge);
        if (evaluation.verdict != Evaluation::Verdict::kValid) return;
        const EdgeStar star = p.mesh.star(edge);
        const Fan& fan = evaluator_.fan();
        if (guard_ && !replacement_.try_on(*guard_, fan, evaluation.position, {face_of(star.ij), face_of(star.ji)})) {
            ++refused_;
            return;
        }
        ++collapses_;
        p.log.record(p.mesh, star, evaluation.position);
        p.state.quadrics[p.mesh.origin(star.ij)] += p.state.quadrics[p.mesh.origin(star.ji)];
        p.mesh.collapse(star, evaluation.position);
        for (std::size_t t = 0; t < fan.size(); ++t) {
            p.state.faces[fan.face(t)] = {fan.normal(t), fan.stretch(t), fan.face_size(t)};
        }
    }

    const Extended<ImprovePolicy> policy_{};
    Random random_;
    const SurfaceIndex index_;
    EdgeEvaluator<Extended<ImprovePolicy>> evaluator_;
    std::optional<DeviationGuard> guard_;
    FanReplacement replacement_;
    int collapses_ = 0;
    int refused_ = 0;
};

/// Largest distance to `source` of the vertices and centroids of `mesh`, by trying every face of it.
double from_mesh(const TriangleMesh& mesh, const TriangleMesh& source) {
    double largest = 0;
    const auto distance = [&](const Vec3& p) {
        double nearest = 1e300;
        for (const Triangle& t : source.faces) {
            const TriangleShape shape{{source.positions[t[0]], source.positions[t[1]], source.positions[t[2]]}};
            nearest = std::min(nearest, shape.closest(p).squared_distance);
        }
        return std::sqrt(nearest);
    };
    for (const Triangle& t : mesh.faces) {
        const Vec3 &a = mesh.positions[t[0]], &b = mesh.positions[t[1]], &c = mesh.positions[t[2]];
        for (const Vec3& p : {a, b, c, Vec3((a + b + c) / 3)}) largest = std::max(largest, distance(p));
    }
    return largest;
}

/// Largest distance to `mesh` of the vertices of `source`.
double from_source(const TriangleMesh& source, const TriangleMesh& mesh) {
    double largest = 0;
    for (const Vec3& p : source.positions) {
        double nearest = 1e300;
        for (const Triangle& t : mesh.faces) {
            const TriangleShape shape{{mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]}};
            nearest = std::min(nearest, shape.closest(p).squared_distance);
        }
        largest = std::max(largest, std::sqrt(nearest));
    }
    return largest;
}

TEST(DeviationGuardTest, SamplesOfBothSurfacesStayWithinTheLimit) {
    const std::vector<NamedMesh> sources{{"bumpy sphere", bumpy_sphere(3, 0.03, 1)},
                                         {"noisy cube", noisy_cube(8, 0.2, 2)},
                                         {"jittered cube", jittered_cube(8, 0.15, 3)},
                                         {"torus", torus(30, 12)},
                                         {"plate", plate_with_holes(2)},
                                         {"cylinder", sliver_cylinder(40, 0.5)}};
    for (const auto& [name, source] : sources) {
        for (const double share : {3e-3, 1e-2}) {
            SCOPED_TRACE(name + ", limit " + std::to_string(share) + " of the diagonal");
            const double limit = share * bounding_box(source).diagonal();
            GuardedEditor editor(source, 0.01, limit, 7);
            editor.edit(60, 12000);
            EXPECT_LE(from_mesh(editor.p.now(), source), limit * (1 + 1e-9));
            EXPECT_LE(from_source(source, editor.p.now()), limit * (1 + 1e-9));
            EXPECT_TRUE(editor.collapses() > 20 || name == "plate") << editor.collapses();
            expect_consistent(editor.p);
        }
    }
}

TEST(DeviationGuardTest, WithoutItTheSameEditsGoFurther) {
    const TriangleMesh source = bumpy_sphere(3, 0.03, 1);
    const double limit = 3e-3 * bounding_box(source).diagonal();
    GuardedEditor guarded(source, 0.1, limit, 7);
    guarded.edit(60, 12000);
    EXPECT_GT(guarded.refused(), 100);
    GuardedEditor free(source, 0.1, std::nullopt, 7);
    free.edit(60, 12000);
    EXPECT_GT(from_mesh(free.p.now(), source), 2 * limit);
    EXPECT_GT(from_source(source, free.p.now()), 2 * limit);
}

/// A cube of grids, a guard on it, and the star of a vertex within a side.
struct OnTheSide {
    Polishing p{noisy_cube(6, 0, 1), 1e-3};
    SurfaceIndex index = surface_index(p.input.mesh);
    DeviationGuard guard;
    std::uint32_t v = 0;
    std::vector<std::uint32_t> old;

    explicit OnTheSide(double limit) : guard(p.mesh, index, limit) {
        while ((p.mesh.position(v) - Vec3(0.5, 0.5, 1)).norm() > 1e-9) ++v;
        p.mesh.for_each_outgoing(v, [&](HalfEdge h) { old.push_back(face_of(h)); });
    }

    /// Whether the guard lets the vertex stand at `apex`.
    [[nodiscard]] bool admits(const Vec3& apex, const Vec3& old_normal = Vec3(0, 0, 1)) {
        std::vector<DeviationGuard::NewFace> faces;
        p.mesh.for_each_outgoing(v, [&](HalfEdge h) {
            faces.push_back(
                {face_of(h), apex, p.mesh.position(p.mesh.target(h)), p.mesh.position(p.mesh.origin(prev(h))), old_normal});
        });
        return guard.replace(old, faces);
    }
};

TEST(DeviationGuardTest, AnApexIsTriedAgainstTheSource) {
    const double limit = 0.01;
    for (const double side : {1.0, -1.0}) {
        EXPECT_TRUE(OnTheSide(limit).admits({0.5, 0.5, 1 + side * 0.99 * limit}));
        EXPECT_FALSE(OnTheSide(limit).admits({0.5, 0.5, 1 + side * 1.01 * limit}));
        EXPECT_FALSE(OnTheSide(limit).admits({0.5, 0.5, 1 + side * 1.01 * limit}, Vec3::Zero())) << "normal not known";
    }
}

TEST(DeviationGuardTest, MovingWithinThePlaneIsFreeAndARefusalLeavesNothingBehind) {
    OnTheSide at(0.01);
    for (int n = 0; n < 3; ++n) EXPECT_FALSE(at.admits({0.5, 0.5, 1.5}));
    EXPECT_TRUE(at.admits({0.55, 0.48, 1}));
    EXPECT_TRUE(at.admits({0.45, 0.53, 1}));
    EXPECT_FALSE(at.admits({0.5, 0.5, 0.5}));
    EXPECT_TRUE(at.admits({0.5, 0.5, 1.009}));
}

TEST(DeviationGuardTest, APointOfTheSourceIsNotLeftBehind) {
    // A spike on the side: faces that close over its foot lie on the source, but its tip is not near them.
    TriangleMesh spiked = noisy_cube(6, 0, 1);
    for (Vec3& p : spiked.positions) {
        if ((p - Vec3(0.5, 0.5, 1)).norm() < 1e-9) p.z() = 1.3;
    }
    for (const double limit : {0.29, 0.31}) {
        const SurfaceIndex index = surface_index(spiked);
        const HalfEdgeMesh mesh(spiked);
        DeviationGuard guard(mesh, index, limit);
        std::uint32_t v = 0;
        while (mesh.position(v).z() < 1.2) ++v;
        std::vector<std::uint32_t> old;
        std::vector<DeviationGuard::NewFace> faces;
        mesh.for_each_outgoing(v, [&](HalfEdge h) {
            old.push_back(face_of(h));
            faces.push_back({face_of(h), {0.5, 0.5, 1}, mesh.position(mesh.target(h)), mesh.position(mesh.origin(prev(h))), {}});
        });
        EXPECT_EQ(guard.replace(old, faces), limit > 0.3);
    }
}

TEST(DeviationGuardTest, AFaceIsTriedInItsMiddleAndAlongItsSides) {
    const TriangleMesh flat = noisy_cube(6, 0, 1);
    TriangleMesh dented = flat;
    for (Vec3& p : dented.positions) {
        if ((p - Vec3(0.5, 0.5, 1)).norm() < 1e-9) p.z() = 0.7;
    }
    const Vec3 unknown(0, 0, 0);  // else a face in the plane of the old one is not tried
    const DeviationGuard::NewFace middle_over_it{0, {0.5, 0.9, 1}, {0.1, 0.3, 1}, {0.9, 0.3, 1}, unknown};
    const DeviationGuard::NewFace side_over_it{0, {0.1, 0.5, 1}, {0.9, 0.5, 1}, {0.5, 0.95, 1}, unknown};
    for (const auto& face : {middle_over_it, side_over_it}) {
        for (const TriangleMesh& source : {flat, dented}) {
            const SurfaceIndex index = surface_index(source);
            DeviationGuard guard(HalfEdgeMesh(source), index, 0.1);
            EXPECT_EQ(guard.replace({}, std::array{face}), source == flat);
        }
    }
}

/// A floor and a wall that meet, and the two faces of a fin across their corner, from the floor at `reach` to the wall at
/// `height`.
bool admits_fin(double reach, double height, double limit) {
    TriangleMesh corner;
    corner.positions = {{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}, {0, 0, 1}, {0, 1, 1}};
    corner.faces = {{0, 2, 1}, {1, 2, 3}, {0, 1, 4}, {1, 5, 4}};
    const SurfaceIndex index = surface_index(corner);
    DeviationGuard guard(HalfEdgeMesh(noisy_cube(2, 0, 1)), index, limit);
    const Vec3 apex(reach, 0.5, 0), top(0, 0.5, height), foot(0, 0.5, 0);
    // Either face is in the plane of what was there, as where a smaller fin grows.
    const std::array<DeviationGuard::NewFace, 2> faces{{{0, apex, top, foot, {0, -1, 0}}, {1, apex, foot, top, {0, 1, 0}}}};
    return guard.replace({}, faces);
}

TEST(DeviationGuardTest, AFinDoesNotGrowInItsOwnPlane) {
    EXPECT_TRUE(admits_fin(0.05, 0.5, 0.1));
    EXPECT_FALSE(admits_fin(0.5, 0.5, 0.1));
    EXPECT_FALSE(admits_fin(0.19, 1, 0.1)) << "near in its middle, too far beside it";
}

}  // namespace
}  // namespace vsplit::test

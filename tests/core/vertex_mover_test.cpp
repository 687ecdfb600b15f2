#include "simplify/vertex_mover.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "simplify/policies.h"
#include "tests/core/meshes.h"
#include "tests/core/polishing.h"
#include "tests/core/random.h"
#include "vsplit/mrr/progressive_mesh.h"

namespace vsplit::test {
namespace {

/// The faces around a vertex, measured anew.
struct Star {
    std::vector<std::uint32_t> faces;
    std::vector<FaceState> figures;

    Star(const Polishing& p, std::uint32_t v) {
        p.mesh.for_each_outgoing(v, [&](HalfEdge h) {
            faces.push_back(face_of(h));
            figures.push_back(p.measured(face_of(h)));
        });
    }
    [[nodiscard]] double least() const {
        double result = 1;
        for (const FaceState& f : figures) result = std::min(result, f.stretch);
        return result;
    }
    [[nodiscard]] double largest() const {
        double result = 0;
        for (const FaceState& f : figures) result = std::max(result, f.size);
        return result;
    }
    [[nodiscard]] double defect() const {
        double sum = 0;
        for (const FaceState& f : figures) sum += (1 - f.stretch) * (1 - f.stretch);
        return sum / static_cast<double>(figures.size());
    }
};

std::vector<NamedMesh> sources() {
    return {{"jittered cube", jittered_cube(8, 0.15, 1)}, {"noisy cube", noisy_cube(7, 0.25, 2)},
            {"bumpy sphere", bumpy_sphere(3, 0.06, 3)},   {"torus", torus(30, 9)},
            {"cylinder", sliver_cylinder(24, 0.3)},       {"plate", plate_with_holes(2)}};
}

using Promise = std::function<void(const Star& before, const Star& after, bool moved)>;
using Move = std::function<void(VertexMover&, std::uint32_t v)>;

/// Moves every vertex of `p` once and checks what any move must keep to, and `promise`. The number that moved.
int move_all(Polishing& p, const PolishLimits& limits, const Move& move, const Promise& promise) {
    VertexMover mover(p.mesh, p.state, p.log, {}, limits);
    int moved = 0;
    for (std::uint32_t v = 0; v < p.mesh.vertex_count(); ++v) {
        const Star before(p, v);
        const Vec3 was = p.mesh.position(v);
        move(mover, v);
        const Star after(p, v);
        const bool went = p.mesh.position(v) != was;
        promise(before, after, went);
        if (!went) continue;
        ++moved;
        for (std::size_t t = 0; t < before.faces.size(); ++t) {
            EXPECT_GT(before.figures[t].normal.dot(after.figures[t].normal), 0.199F) << "folds at " << v;
        }
        const Quadric& quadric = p.state.quadrics[v];
        const double error = quadric.error(p.mesh.position(v) - limits.centre);
        const double square = limits.tolerance * limits.tolerance;
        EXPECT_LE(error, std::max(square, quadric.trace() * square) * (1 + 1e-9)) << "vertex " << v;
        EXPECT_LE(after.largest(), std::max(limits.max_size, before.largest()) * (1 + 1e-12)) << "vertex " << v;
    }
    expect_consistent(p);
    return moved;
}

TEST(VertexMoverTest, RelaxingBettersTheMeanShapeAroundEveryVertexItMoves) {
    for (const auto& [name, source] : sources()) {
        SCOPED_TRACE(name);
        Polishing p(source, 5e-3);
        const auto promise = [](const Star& before, const Star& after, bool moved) {
            if (moved) {
                EXPECT_LT(after.defect(), before.defect() - kLeastGain * (1 - 1e-9));
            } else {
                EXPECT_EQ(after.defect(), before.defect());
            }
        };
        const auto relax = [](VertexMover& mover, std::uint32_t v) { mover.relax(v); };
        EXPECT_GT(move_all(p, p.limits(), relax, promise), 5);
    }
}

/// A cone upside down: its flat top a fan around the origin, the rim as far away as chance has it.
TriangleMesh ragged_fan(std::uint32_t corners, Random& random) {
    TriangleMesh mesh{{{0, 0, 0}, {0, 0, -1}}, {}};
    for (std::uint32_t n = 0; n < corners; ++n) {
        const double angle = 2 * 3.14159265358979 * n / corners;
        mesh.positions.push_back(random.uniform(0.05, 3) * Vec3(std::cos(angle), std::sin(angle), 0));
        const std::uint32_t here = 2 + n, then = 2 + (n + 1) % corners;
        mesh.faces.push_back({0, here, then});
        mesh.faces.push_back({1, then, here});
    }
    return mesh;
}

TEST(VertexMoverTest, NothingFoldsWhereABetterShapeWould) {
    Random random(1);
    int moved = 0;
    for (int n = 0; n < 300; ++n) {
        Polishing p(ragged_fan(5 + random.below(4), random), 1);
        VertexMover mover(p.mesh, p.state, p.log, {}, p.limits());
        std::uint32_t v = 0;
        while (p.mesh.position(v) != Vec3::Zero()) ++v;
        n % 2 == 0 ? mover.relax(v) : mover.lift(v, 1);
        moved += p.mesh.position(v) != Vec3::Zero() ? 1 : 0;
        for (const FaceState& face : Star(p, v).figures) EXPECT_GT(face.normal.z(), 0.999F) << "fan " << n;
    }
    EXPECT_GT(moved, 150);
}

TEST(VertexMoverTest, TheErrorStaysWithinASmallTolerance) {
    const TriangleMesh source = bumpy_sphere(3, 0.06, 3);
    const auto relax = [](VertexMover& mover, std::uint32_t v) { mover.relax(v); };
    const auto count = [&](double share) {
        Polishing p(source, share);
        return move_all(p, p.limits(), relax, [](const Star&, const Star&, bool) {});
    };
    const int loose = count(1e-2);
    const int tight = count(5e-5);
    EXPECT_GT(tight, 5);
    EXPECT_LT(tight, loose) << "else the tolerance did nothing";
    EXPECT_EQ(count(1e-9), 0);
}

constexpr double kGoal = 0.75;

TEST(VertexMoverTest, LiftingRaisesTheLeastStretchUnderTheGoal) {
    for (const auto& [name, source] : sources()) {
        SCOPED_TRACE(name);
        Polishing p(source, 5e-3);
        const auto promise = [](const Star& before, const Star& after, bool moved) {
            if (!moved) return;
            EXPECT_LT(before.least(), kGoal);
            EXPECT_GT(after.least(), before.least() + kLeastGain * (1 - 1e-9));
        };
        const auto lift = [](VertexMover& mover, std::uint32_t v) { mover.lift(v, kGoal); };
        const int moved = move_all(p, p.limits(), lift, promise);
        if (name != "plate") {
            EXPECT_GT(moved, 5);
        }
    }
}

TEST(VertexMoverTest, NothingIsLiftedThatReachesTheGoal) {
    Polishing p(noisy_cube(7, 0.25, 4), 5e-3);
    const auto lift = [](VertexMover& mover, std::uint32_t v) { mover.lift(v, 0); };
    EXPECT_EQ(move_all(p, p.limits(), lift, [](const Star&, const Star&, bool) {}), 0);
}

TEST(VertexMoverTest, FacesGrowNoLargerThanTheBoundOrThanTheyWere) {
    Polishing p(jittered_cube(8, 0.15, 5), 5e-3);
    PolishLimits limits = p.limits();
    limits.max_size = 1.2 / 8;
    const auto both = [](VertexMover& mover, std::uint32_t v) {
        mover.relax(v);
        mover.lift(v, kGoal);
    };
    int grown = 0;
    const auto promise = [&](const Star& before, const Star& after, bool moved) {
        if (!moved) return;
        EXPECT_LE(after.largest(), std::max(limits.max_size, before.largest()) * (1 + 1e-12));
    };
    EXPECT_GT(move_all(p, limits, both, promise), 20);
    Polishing free(jittered_cube(8, 0.15, 5), 5e-3);
    const auto count = [&](const Star& before, const Star& after, bool) {
        grown += after.largest() > std::max(limits.max_size, before.largest()) ? 1 : 0;
    };
    move_all(free, free.limits(), both, count);
    EXPECT_GT(grown, 5) << "else the bound did nothing";
}

TEST(VertexMoverTest, CornersStayAndVerticesOfCreasesKeepToTheirLine) {
    const std::uint32_t cells = 8;
    Polishing p(jittered_cube(cells, 0.15, 6), 1e-2);
    const TriangleMesh before = p.now();
    VertexMover mover(p.mesh, p.state, p.log, {}, p.limits());
    for (int round = 0; round < 10; ++round) {
        for (std::uint32_t v = 0; v < p.mesh.vertex_count(); ++v) {
            mover.relax(v);
            mover.lift(v, 0.8);
        }
    }
    const double nothing = 5e-3 / cells;  // what the regularised projection leaves
    int on_edges = 0, inside = 0, along = 0, within = 0;
    for (std::uint32_t v = 0; v < p.mesh.vertex_count(); ++v) {
        const Vec3 was = before.positions[v];
        const Vec3 now = p.mesh.position(v);
        int fixed = 0;
        for (int axis = 0; axis < 3; ++axis) {
            if (was[axis] != 0 && was[axis] != 1) continue;
            ++fixed;
            EXPECT_NEAR(now[axis], was[axis], nothing) << "vertex " << v;
        }
        on_edges += fixed == 2 ? 1 : 0;
        inside += fixed == 1 ? 1 : 0;
        along += fixed == 2 && (now - was).norm() > 10 * nothing ? 1 : 0;
        within += fixed == 1 && (now - was).norm() > 10 * nothing ? 1 : 0;
    }
    EXPECT_EQ(on_edges, 12 * (static_cast<int>(cells) - 1));
    EXPECT_GT(along, on_edges / 4) << "along a crease is free";
    EXPECT_GT(within, inside / 4) << "and so is a plane";
}

/// A sphere whose vertices have been shifted along it, by up to `share` of an edge.
TriangleMesh shifted_sphere(double share, Random& random) {
    TriangleMesh mesh = icosphere(3);
    const Triangle& t = mesh.faces[0];
    const double most = share * (mesh.positions[t[0]] - mesh.positions[t[1]]).norm();
    for (Vec3& p : mesh.positions) {
        p += most * Vec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
        p.normalize();
    }
    return mesh;
}

TEST(VertexMoverTest, VerticesSlideOverACurvedSurfaceWhateverPlanesTheyHaveGathered) {
    Random random(11);
    Polishing p(shifted_sphere(0.35, random), 0.02);
    // As after collapses: each has the planes all around it, which no point but one is near to.
    const std::vector<Quadric> own = p.state.quadrics;
    for (std::uint32_t v = 0; v < p.mesh.vertex_count(); ++v) {
        p.mesh.for_each_outgoing(v, [&](HalfEdge h) { p.state.quadrics[v] += own[p.mesh.target(h)]; });
    }
    const auto mean = [&] {
        double sum = 0;
        for (const FaceState& f : p.state.faces) sum += f.stretch;
        return sum / static_cast<double>(p.state.faces.size());
    };
    const double before = mean();
    VertexMover mover(p.mesh, p.state, p.log, {}, p.limits());
    for (int round = 0; round < 10; ++round) {
        for (std::uint32_t v = 0; v < p.mesh.vertex_count(); ++v) mover.relax(v);
    }
    EXPECT_LT(before, 0.8);
    EXPECT_GT(mean(), 0.9);
    for (std::uint32_t v = 0; v < p.mesh.vertex_count(); ++v) EXPECT_NEAR(p.mesh.position(v).norm(), 1, 0.02) << v;
}

TEST(VertexMoverTest, FewerMovesAreWorthARecordWhereTheSurfaceBendsAndAsManyWhereItIsFlat) {
    const auto moved = [](Polishing&& p, VertexMover::Moves moves) {
        VertexMover mover(p.mesh, p.state, p.log, {}, p.limits());
        int count = 0;
        for (std::uint32_t v = 0; v < p.mesh.vertex_count(); ++v) {
            const Vec3 before = p.mesh.position(v);
            mover.relax(v, moves);
            count += p.mesh.position(v) == before ? 0 : 1;
        }
        return count;
    };
    const auto ball = [&] {
        Random random(11);
        return Polishing(shifted_sphere(0.1, random), 0.02);
    };
    const int all = moved(ball(), VertexMover::Moves::kAll);
    const int worthwhile = moved(ball(), VertexMover::Moves::kWorthwhile);
    EXPECT_GT(all, 200);
    EXPECT_LT(worthwhile, all / 2);
    const auto cube = [] { return Polishing(jittered_cube(8, 0.15, 2), 0.02); };
    EXPECT_GT(moved(cube(), VertexMover::Moves::kAll), 100);
    EXPECT_EQ(moved(cube(), VertexMover::Moves::kWorthwhile), moved(cube(), VertexMover::Moves::kAll));
}

TEST(VertexMoverTest, TheLogLeadsBackToWhereVerticesLay) {
    Polishing p(bumpy_sphere(2, 0.05, 8), 0.05);
    const TriangleMesh finest = p.now();
    // A collapse first: what was edited before it is not kept.
    for (const HalfEdge h : p.edges()) {
        const EdgeStar star = p.mesh.star(h);
        if (p.mesh.valence(p.mesh.origin(star.ei)) < 4 || p.mesh.valence(p.mesh.origin(star.bj)) < 4) continue;
        const Vec3 position = p.mesh.position(p.mesh.origin(star.ij));
        p.log.record(p.mesh, star, position);
        p.mesh.collapse(star, position);
        break;
    }
    for (std::uint32_t f = 0; f < p.state.faces.size(); ++f) {
        if (!p.mesh.removed(3 * f)) p.state.faces[f] = p.measured(f);
    }
    VertexMover mover(p.mesh, p.state, p.log, {}, p.limits());
    for (std::uint32_t v = 0; v < p.mesh.vertex_count(); ++v) {
        if (p.mesh.outgoing(v) == kNone) continue;
        mover.relax(v);
        mover.lift(v, 0.9);
    }
    const MultiresMesh mrr = p.log.build(p.mesh);
    EXPECT_GT(mrr.records.moves().size(), 10U);
    ASSERT_EQ(mrr.levels(), 1U);
    EXPECT_EQ(unnumbered(mesh_at(mrr, 1)), unnumbered(finest));
}

}  // namespace
}  // namespace vsplit::test

#include "simplify/border_guard.h"

#include <gtest/gtest.h>

#include <array>

#include "mesh/cap_boundaries.h"
#include "simplify/deviation_guard.h"
#include "simplify/fan_replacement.h"
#include "tests/core/meshes.h"

namespace vsplit::test {
namespace {

/// A mesh with boundaries, and the open star of one of its boundary vertices.
struct Star {
    CappedMesh capped;
    HalfEdgeMesh mesh;
    Border border;
    std::uint32_t v;
    Fan fan;

    Star(const TriangleMesh& source, const Vec3& at)
        : capped(cap_manifold(source)), mesh(capped.mesh, capped.ghosts), border(capped.mesh, capped.ghosts, {}, false), v(0) {
        while (border.is_ghost(v) || (mesh.position(v) - at).norm() > 1e-12) ++v;
        std::size_t t = 0;
        mesh.for_each_outgoing(v, [&](HalfEdge h) {
            fan.put(t++, mesh.target(h), mesh.position(mesh.target(h)), face_of(h), Eigen::Vector3f(0, 0, 1));
        });
        fan.open_at(border.ghost_beside(v), t);
    }
};

TEST(BorderGuardTest, TheBoundaryStaysWithinTheLimitOnEitherSide) {
    for (const double side : {1.0, -1.0}) {
        Star star(square(4), Vec3(2, 0, 0));
        BorderGuard guard(star.mesh, star.border, 0.1);
        EXPECT_TRUE(guard.admits(star.fan, Vec3(2, side * 0.09, 0), {star.v, kNone}));
        EXPECT_FALSE(guard.admits(star.fan, Vec3(2, side * 0.11, 0), {star.v, kNone}));
        EXPECT_TRUE(guard.admits(star.fan, Vec3(2.4, 0, 0), {star.v, kNone})) << "along it";
    }
}

/// A strip with a slit of width 0.04 in its lower side.
TriangleMesh slit() {
    TriangleMesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1.02, 0.5, 0}, {1.04, 0, 0}, {2, 0, 0}, {0, 1, 0}, {1.02, 1, 0}, {2, 1, 0}};
    mesh.faces = {{0, 1, 5}, {1, 6, 5}, {1, 2, 6}, {2, 3, 6}, {3, 4, 7}, {3, 7, 6}};
    return mesh;
}

TEST(BorderGuardTest, ASlitNarrowerThanTheLimitDoesNotClose) {
    const Vec3 mouth(1.02, 0, 0);
    Star star(slit(), Vec3(1.02, 0.5, 0));
    const SurfaceIndex index = surface_index(slit());
    DeviationGuard guard(star.mesh, index, 0.05, kNone, star.border);
    ASSERT_NE(guard.border(), nullptr);
    EXPECT_FALSE(FanReplacement().try_on(guard, star.fan, mouth, {}, {star.v, kNone}));
    DeviationGuard surface_only(star.mesh, index, 0.05);
    EXPECT_EQ(surface_only.border(), nullptr);
    BorderGuard loose(star.mesh, star.border, 0.51);
    EXPECT_TRUE(loose.admits(star.fan, mouth, {star.v, kNone}));
}

TEST(BorderGuardTest, PointsFollowTheEdgesTheyAreNear) {
    // A vertex goes away step by step, each within the limit of where it was, but not of where it began.
    Star star(square(4), Vec3(2, 0, 0));
    BorderGuard guard(star.mesh, star.border, 0.25);
    EXPECT_TRUE(guard.admits(star.fan, Vec3(2, 0.2, 0), {star.v, kNone}));
    guard.commit();
    EXPECT_FALSE(guard.admits(star.fan, Vec3(2, 0.4, 0), {star.v, kNone}));
    EXPECT_TRUE(guard.admits(star.fan, Vec3(2, 0, 0), {star.v, kNone})) << "a refusal leaves nothing behind";
    guard.commit();
    EXPECT_TRUE(guard.admits(star.fan, Vec3(2, -0.2, 0), {star.v, kNone}));
}

TEST(BorderGuardTest, WithoutBoundariesThereIsNone) {
    const HalfEdgeMesh mesh(cube());
    const SurfaceIndex index = surface_index(cube());
    EXPECT_EQ(DeviationGuard(mesh, index, 0.1).border(), nullptr);
}

}  // namespace
}  // namespace vsplit::test

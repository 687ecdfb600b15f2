#include "simplify/crease_guard.h"

#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "tests/core/meshes.h"
#include "vsplit/io/read_mesh.h"
#include "vsplit/method/improve.h"
#include "vsplit/mrr/progressive_mesh.h"
#include "vsplit/quality/crease_deviation.h"

namespace vsplit::test {
namespace {

/// A square with its lower side as three creases.
class CreaseGuardTest : public testing::Test {
protected:
    [[nodiscard]] CreaseGuard guard(double limit) const { return {mesh_, creases(), limit}; }

    [[nodiscard]] HalfEdge crease_number(std::uint32_t a, std::uint32_t b) const {
        HalfEdge number = kNone;
        mesh_.for_each_outgoing(a, [&](HalfEdge h) { number = mesh_.target(h) == b ? mesh_.edge_of(h) : number; });
        return number;
    }

    [[nodiscard]] std::vector<HalfEdge> all() const { return {crease_number(0, 1), crease_number(1, 3)}; }

    static std::vector<SharpEdge> creases() { return {{0, 1, 10}, {1, 3, 10}}; }

    const HalfEdgeMesh mesh_{TriangleMesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {2, 0, 0}, {1, 1, 1}},
                                          {{0, 1, 2}, {1, 3, 2}, {0, 2, 4}, {2, 3, 4}, {3, 1, 4}, {1, 0, 4}}}};
};

TEST_F(CreaseGuardTest, LetsACreaseGoWhereAnotherIsNear) {
    CreaseGuard guard = this->guard(0.1);
    const std::array near{CreaseGuard::NewCrease{7, Vec3(0, 0.05, 0), Vec3(2, 0.05, 0)}};
    EXPECT_TRUE(guard.admits(all(), near));
}

TEST_F(CreaseGuardTest, KeepsACreaseThatWouldBeGoneOrFarOrShort) {
    CreaseGuard guard = this->guard(0.1);
    const std::array far{CreaseGuard::NewCrease{7, Vec3(0, 0.11, 0), Vec3(2, 0.11, 0)}};
    const std::array half{CreaseGuard::NewCrease{7, Vec3(0, 0, 0), Vec3(1, 0, 0)}};
    EXPECT_FALSE(guard.admits(all(), {}));
    EXPECT_FALSE(guard.admits(all(), far));
    EXPECT_FALSE(guard.admits(all(), half));
    EXPECT_TRUE(guard.admits(std::array{crease_number(0, 1)}, half));
}

TEST_F(CreaseGuardTest, PointsGoBackToTheNearestCreaseIfOneIsWithinTheLimit) {
    CreaseGuard guard = this->guard(0.1);
    const HalfEdge left = crease_number(0, 1), right = crease_number(1, 3);
    // All are handed on to the right one, though those of the left half are nearer to the left one.
    ASSERT_TRUE(guard.admits(all(), std::array{CreaseGuard::NewCrease{right, Vec3(0, 0, 0), Vec3(2, 0, 0)}}));
    guard.commit(all());
    ASSERT_FALSE(guard.holds_points(left));
    guard.go_to_nearest({{left, Vec3(0, 0, 0), Vec3(1, 0, 0)}, {right, Vec3(1, 0, 0), Vec3(2, 0, 0)}});
    EXPECT_TRUE(guard.holds_points(left));
    EXPECT_TRUE(guard.holds_points(right));
    const std::array half{CreaseGuard::NewCrease{7, Vec3(0, 0, 0), Vec3(1, 0, 0)}};
    EXPECT_TRUE(guard.admits(std::array{left}, half));
    EXPECT_FALSE(guard.admits(std::array{right}, half));
    // None is within the limit: they stay.
    guard.go_to_nearest({{left, Vec3(0, 0.2, 0), Vec3(2, 0.2, 0)}});
    EXPECT_TRUE(guard.holds_points(right));
}

TEST_F(CreaseGuardTest, PointsFollowTheCreaseTheyWentOverTo) {
    CreaseGuard guard = this->guard(0.1);
    const HalfEdge kept = crease_number(1, 3);
    const std::array first{CreaseGuard::NewCrease{kept, Vec3(0, 0.08, 0), Vec3(2, 0.08, 0)}};
    ASSERT_TRUE(guard.admits(all(), first));
    guard.commit(all());
    // Near the first replacement, but not near the source any more.
    const std::array second{CreaseGuard::NewCrease{kept, Vec3(0, 0.12, 0), Vec3(2, 0.12, 0)}};
    EXPECT_FALSE(guard.admits(std::array{kept}, second));
    EXPECT_TRUE(guard.admits(std::array{kept}, first));
    EXPECT_TRUE(guard.admits(std::array{crease_number(0, 1)}, {})) << "its points are elsewhere now";
}

/// A crease may not go by more than a quarter of the bound beyond what its points allow, at its ends either.
TEST_F(CreaseGuardTest, BetweenPointsACreaseIsNoFurtherThanTheBound) {
    constexpr double kBound = 0.1;
    CreaseGuard guard = this->guard(0.75 * kBound);
    for (int step = 0; step < 300; ++step) {
        const double missing = 0.001 * step;  // at one end
        const std::array shorter{CreaseGuard::NewCrease{7, Vec3(missing, 0, 0), Vec3(2, 0, 0)}};
        if (guard.admits(all(), shorter)) {
            EXPECT_LE(missing, kBound);
        }
    }
}

TEST_F(CreaseGuardTest, ATryThatIsNotCommittedChangesNothing) {
    CreaseGuard guard = this->guard(0.1);
    const std::array near{CreaseGuard::NewCrease{crease_number(1, 3), Vec3(0, 0, 0), Vec3(2, 0, 0)}};
    ASSERT_TRUE(guard.admits(all(), near));
    EXPECT_FALSE(guard.admits(std::array{crease_number(0, 1)}, {}));
}

/// A plate with a step in it that is far lower than the tolerance: the surface alone would let it go flat.
TriangleMesh plate_with_step(double height) {
    TriangleMesh mesh{{{0, 0, 0},
                       {1, 0, 0},
                       {1, 1, 0},
                       {0, 1, 0},
                       {0, 0, 0.2},
                       {0.4, 0, 0.2},
                       {0.4, 1, 0.2},
                       {0, 1, 0.2},
                       {0.4, 0, 0.2 + height},
                       {1, 0, 0.2 + height},
                       {1, 1, 0.2 + height},
                       {0.4, 1, 0.2 + height}},
                      {}};
    const auto quad = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
        mesh.faces.push_back({a, b, c});
        mesh.faces.push_back({a, c, d});
    };
    quad(3, 2, 1, 0);
    quad(4, 5, 6, 7);
    quad(8, 9, 10, 11);
    quad(5, 8, 11, 6);
    quad(0, 4, 7, 3);
    quad(1, 2, 10, 9);
    mesh.faces.insert(mesh.faces.end(),
                      {{0, 5, 4}, {0, 1, 5}, {5, 1, 9}, {5, 9, 8}, {3, 7, 6}, {3, 6, 2}, {6, 10, 2}, {6, 11, 10}});
    return mesh;
}

TEST(CreaseGuardMethodTest, AStepFarLowerThanTheToleranceKeepsBothItsCreases) {
    const TriangleMesh source = plate_with_step(5e-4);
    ImproveOptions options;
    options.tolerance = 2e-3;
    options.faces = 800;
    const Expected<MethodResult> result = improve(source, options, {}, {});
    ASSERT_TRUE(result.has_value()) << result.error().message;
    for (const std::uint32_t faces : {result->faces, result->mrr.faces_min()}) {
        const TriangleMesh mesh = mesh_at(result->mrr, result->mrr.level_for(faces));
        const Expected<CreaseDeviation> creases = measure_crease_deviation(mesh, source, {.lost_distance = 4e-3}, {});
        ASSERT_TRUE(creases.has_value());
        EXPECT_EQ(creases->lost, 0) << faces;
    }
}

TEST(CreaseGuardMethodTest, NoCreaseOfARealPartIsLost) {
    for (const std::filesystem::path& path : own_closed_meshes()) {
        SCOPED_TRACE(path.filename());
        const Expected<ReadResult> read = read_mesh_file(path, {});
        ASSERT_TRUE(read.has_value());
        const Expected<MethodResult> result = improve(read->mesh, {.faces = 2000}, {}, {});
        ASSERT_TRUE(result.has_value()) << result.error().message;
        const TriangleMesh mesh = mesh_at(result->mrr, result->mrr.level_for(result->faces));
        const Expected<CreaseDeviation> creases = measure_crease_deviation(mesh, read->mesh, {}, {});
        ASSERT_TRUE(creases.has_value());
        // Samples are kept, not all between them; of a scan's creases those that noise makes are left out before.
        EXPECT_LE(creases->lost, path.stem() == "scan" ? 0.1 : 3e-3);
    }
}

}  // namespace
}  // namespace vsplit::test

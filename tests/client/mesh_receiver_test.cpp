#include "vsplit/client/mesh_receiver.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/client/some_mrr.h"
#include "tests/core/edited_mrr.h"
#include "vsplit/mesh/inspect.h"

namespace vsplit::client {
namespace {

class MeshReceiverTest : public testing::Test {
protected:
    /// Those that lead from one level to another.
    [[nodiscard]] RecordSpan records(std::size_t from, std::size_t to) const {
        const std::size_t first = mrr_.record_of_level(from);
        return mrr_.records.slice(first, mrr_.record_of_level(to) - first);
    }
    [[nodiscard]] std::uint32_t number(std::size_t level) const {
        return static_cast<std::uint32_t>(mrr_.record_of_level(level));
    }

    MultiresMesh mrr_ = test::some_mrr(50);
    MeshReceiver receiver_;
};

TEST_F(MeshReceiverTest, BuildsEveryResolutionThatHasCome) {
    ASSERT_TRUE(receiver_.begin(mrr_.base));
    ASSERT_TRUE(receiver_.append(0, records(0, 20)));
    ASSERT_TRUE(receiver_.append(number(20), records(20, 50)));
    EXPECT_EQ(receiver_.faces_held(), mrr_.faces_max());
    EXPECT_EQ(receiver_.records_held(), mrr_.records.size());
    EXPECT_EQ(receiver_.held(), mrr_);
    for (const std::size_t level : {50, 0, 33, 12, 49}) {
        ASSERT_TRUE(receiver_.show(mrr_.faces_at(level)));
        EXPECT_EQ(receiver_.mesh(), mesh_at(mrr_, level)) << level;
    }
}

TEST_F(MeshReceiverTest, BuildsOpenMeshesFromRunsThatBreakAnywhere) {
    for (const TriangleMesh& mesh : {test::square(9), test::punctured(test::torus(16, 10), {0, 35, 70, 105})}) {
        mrr_ = test::edited_mrr(mesh, 80, 3).mrr;
        ASSERT_GT(mrr_.records.flips().size(), 0U);
        ASSERT_TRUE(receiver_.begin(mrr_.base, mrr_.ghosts));
        EXPECT_EQ(receiver_.mesh(), mesh_at(mrr_, 0));
        test::Random random(8);
        while (receiver_.records_held() < mrr_.records.size()) {
            const std::size_t at = receiver_.records_held();
            const std::size_t count = std::min<std::size_t>(1 + random.below(9), mrr_.records.size() - at);
            ASSERT_TRUE(receiver_.append(receiver_.records_held(), mrr_.records.slice(at, count)));
            EXPECT_TRUE(require_manifold(inspect(receiver_.mesh())));
            if (random.below(4) > 0) continue;
            const std::size_t level = random.below(static_cast<std::uint32_t>(receiver_.held().levels()) + 1);
            ASSERT_TRUE(receiver_.show(mrr_.faces_at(level)));
            ASSERT_EQ(receiver_.mesh(), mesh_at(mrr_, level));
        }
        EXPECT_EQ(receiver_.held(), mrr_);
        EXPECT_EQ(receiver_.faces_held(), mesh.face_count());
    }
}

TEST_F(MeshReceiverTest, GoesOnAfterACoarserResolutionWasShown) {
    ASSERT_TRUE(receiver_.begin(mrr_.base));
    ASSERT_TRUE(receiver_.append(0, records(0, 20)));
    ASSERT_TRUE(receiver_.show(mrr_.faces_min()));
    EXPECT_EQ(receiver_.faces_held(), mrr_.faces_at(20));
    ASSERT_TRUE(receiver_.append(number(20), records(20, 25)));
    EXPECT_EQ(receiver_.mesh(), mesh_at(mrr_, 25));
}

TEST_F(MeshReceiverTest, ShowsTheNearestThatIsHeld) {
    ASSERT_TRUE(receiver_.begin(mrr_.base));
    ASSERT_TRUE(receiver_.append(0, records(0, 10)));
    ASSERT_TRUE(receiver_.show(1'000'000));
    EXPECT_EQ(receiver_.mesh().face_count(), mrr_.faces_at(10));
    ASSERT_TRUE(receiver_.show(0));
    EXPECT_EQ(receiver_.mesh().face_count(), mrr_.faces_min());
}

TEST_F(MeshReceiverTest, RefusesRecordsOutOfOrder) {
    EXPECT_EQ(receiver_.append(0, records(0, 1)).error().cause, Cause::kOutOfOrder);
    EXPECT_EQ(receiver_.show(4).error().cause, Cause::kOutOfOrder);
    ASSERT_TRUE(receiver_.begin(mrr_.base));
    EXPECT_EQ(receiver_.append(1, records(1, 2)).error().cause, Cause::kOutOfOrder);
    ASSERT_TRUE(receiver_.append(0, records(0, 2)));
    EXPECT_EQ(receiver_.append(0, records(0, 2)).error().cause, Cause::kOutOfOrder);
    EXPECT_EQ(receiver_.mesh(), mesh_at(mrr_, 2));
}

TEST_F(MeshReceiverTest, IsUnharmedByARecordThatDoesNotFit) {
    ASSERT_TRUE(receiver_.begin(mrr_.base));
    ASSERT_TRUE(receiver_.append(0, records(0, 5)));
    RecordList bad;
    bad.append(records(5, 10));
    bad.push_back(VertexSplit{1'000'000, 1, Vec3::Zero(), Vec3::Zero()});
    EXPECT_EQ(receiver_.append(number(5), bad).error().cause, Cause::kCorrupt);
    EXPECT_EQ(receiver_.mesh(), mesh_at(mrr_, 5));
    EXPECT_EQ(receiver_.faces_held(), mrr_.faces_at(5));
    ASSERT_TRUE(receiver_.append(number(5), records(5, 50)));
    EXPECT_EQ(receiver_.held(), mrr_);
}

TEST_F(MeshReceiverTest, RefusesABaseThatIsNoClosedMesh) {
    TriangleMesh open = mrr_.base;
    open.faces.pop_back();
    EXPECT_EQ(receiver_.begin(open).error().cause, Cause::kOpenMesh);
    TriangleMesh wild = mrr_.base;
    wild.faces[0][0] = 77;
    EXPECT_EQ(receiver_.begin(wild).error().cause, Cause::kIndexOutOfRange);
    EXPECT_EQ(receiver_.begin(mrr_.base, 2).error().cause, Cause::kCorrupt);
    EXPECT_FALSE(receiver_.has_mesh());
}

TEST_F(MeshReceiverTest, StopsAtItsLimit) {
    MeshReceiver small(10);
    ASSERT_TRUE(small.begin(mrr_.base));
    ASSERT_TRUE(small.append(0, records(0, 3)));
    EXPECT_EQ(small.append(number(3), records(3, 4)).error().cause, Cause::kLimitExceeded);
    MeshReceiver tiny(3);
    EXPECT_EQ(tiny.begin(mrr_.base).error().cause, Cause::kLimitExceeded);
}

}  // namespace
}  // namespace vsplit::client

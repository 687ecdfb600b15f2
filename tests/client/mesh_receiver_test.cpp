#include "vsplit/client/mesh_receiver.h"

#include <gtest/gtest.h>

#include <span>

#include "tests/client/some_mrr.h"

namespace vsplit::client {
namespace {

class MeshReceiverTest : public testing::Test {
protected:
    [[nodiscard]] std::span<const VertexSplit> splits(std::size_t first, std::size_t count) const {
        return std::span(mrr_.splits).subspan(first, count);
    }

    MultiresMesh mrr_ = test::some_mrr(50);
    MeshReceiver receiver_;
};

TEST_F(MeshReceiverTest, BuildsEveryResolutionThatHasCome) {
    ASSERT_TRUE(receiver_.begin(mrr_.base));
    ASSERT_TRUE(receiver_.append(0, splits(0, 20)));
    ASSERT_TRUE(receiver_.append(20, splits(20, 30)));
    EXPECT_EQ(receiver_.faces_held(), mrr_.faces_max());
    EXPECT_EQ(receiver_.held(), mrr_);
    for (const std::size_t level : {50, 0, 33, 12, 49}) {
        ASSERT_TRUE(receiver_.show(mrr_.faces_at(level)));
        EXPECT_EQ(receiver_.mesh(), mesh_at(mrr_, level)) << level;
    }
}

TEST_F(MeshReceiverTest, GoesOnAfterACoarserResolutionWasShown) {
    ASSERT_TRUE(receiver_.begin(mrr_.base));
    ASSERT_TRUE(receiver_.append(0, splits(0, 20)));
    ASSERT_TRUE(receiver_.show(mrr_.faces_min()));
    EXPECT_EQ(receiver_.faces_held(), mrr_.faces_at(20));
    ASSERT_TRUE(receiver_.append(20, splits(20, 5)));
    EXPECT_EQ(receiver_.mesh(), mesh_at(mrr_, 25));
}

TEST_F(MeshReceiverTest, ShowsTheNearestThatIsHeld) {
    ASSERT_TRUE(receiver_.begin(mrr_.base));
    ASSERT_TRUE(receiver_.append(0, splits(0, 10)));
    ASSERT_TRUE(receiver_.show(1'000'000));
    EXPECT_EQ(receiver_.mesh().face_count(), mrr_.faces_at(10));
    ASSERT_TRUE(receiver_.show(0));
    EXPECT_EQ(receiver_.mesh().face_count(), mrr_.faces_min());
}

TEST_F(MeshReceiverTest, RefusesRecordsOutOfOrder) {
    EXPECT_EQ(receiver_.append(0, splits(0, 1)).error().cause, Cause::kOutOfOrder);
    EXPECT_EQ(receiver_.show(4).error().cause, Cause::kOutOfOrder);
    ASSERT_TRUE(receiver_.begin(mrr_.base));
    EXPECT_EQ(receiver_.append(1, splits(1, 1)).error().cause, Cause::kOutOfOrder);
    ASSERT_TRUE(receiver_.append(0, splits(0, 2)));
    EXPECT_EQ(receiver_.append(0, splits(0, 2)).error().cause, Cause::kOutOfOrder);
    EXPECT_EQ(receiver_.mesh(), mesh_at(mrr_, 2));
}

TEST_F(MeshReceiverTest, IsUnharmedByASplitThatDoesNotFit) {
    ASSERT_TRUE(receiver_.begin(mrr_.base));
    ASSERT_TRUE(receiver_.append(0, splits(0, 5)));
    std::vector<VertexSplit> bad(mrr_.splits.begin() + 5, mrr_.splits.begin() + 10);
    bad[3].anchor = 1'000'000;
    EXPECT_EQ(receiver_.append(5, bad).error().cause, Cause::kCorrupt);
    EXPECT_EQ(receiver_.mesh(), mesh_at(mrr_, 5));
    EXPECT_EQ(receiver_.faces_held(), mrr_.faces_at(5));
    ASSERT_TRUE(receiver_.append(5, splits(5, 45)));
    EXPECT_EQ(receiver_.held(), mrr_);
}

TEST_F(MeshReceiverTest, RefusesABaseThatIsNoClosedMesh) {
    TriangleMesh open = mrr_.base;
    open.faces.pop_back();
    EXPECT_EQ(receiver_.begin(open).error().cause, Cause::kOpenMesh);
    TriangleMesh wild = mrr_.base;
    wild.faces[0][0] = 77;
    EXPECT_EQ(receiver_.begin(wild).error().cause, Cause::kIndexOutOfRange);
    EXPECT_FALSE(receiver_.has_mesh());
}

TEST_F(MeshReceiverTest, StopsAtItsLimit) {
    MeshReceiver small(10);
    ASSERT_TRUE(small.begin(mrr_.base));
    ASSERT_TRUE(small.append(0, splits(0, 3)));
    EXPECT_EQ(small.append(3, splits(3, 1)).error().cause, Cause::kLimitExceeded);
    MeshReceiver tiny(3);
    EXPECT_EQ(tiny.begin(mrr_.base).error().cause, Cause::kLimitExceeded);
}

}  // namespace
}  // namespace vsplit::client

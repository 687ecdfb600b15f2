#include "service/resolution.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>

#include "tests/core/meshes.h"
#include "vsplit/mrr/progressive_mesh.h"

namespace vsplit::service {
namespace {

using ::testing::HasSubstr;

std::shared_ptr<const Representation> representation_of(const std::string& id, const MultiresMesh& mrr, std::uint32_t faces) {
    static MemoryBudget budget(0);
    MethodFigures figures;
    figures.faces = faces;
    auto levels = Kept<Levels>::hold(std::make_shared<const Levels>(mrr, budget), 0, budget);
    return std::make_shared<const Representation>(id, MethodRequest{}, figures, extent_of(mrr), levels);
}

// A session with representations of 4 to 24 faces, made for 14: before each of ten splits a flip and a move. What they are says
// nothing: a plan does not look at it. Level s has 3s records before it.
SessionSnapshot session_with(int representations) {
    SessionSnapshot session;
    MultiresMesh mrr;
    mrr.base = test::tetrahedron();
    for (int split = 0; split < 10; ++split) {
        for (const Record& record : {Record(EdgeFlip{}), Record(VertexMove{}), Record(VertexSplit{})})
            mrr.records.push_back(record);
    }
    for (int i = 1; i <= representations; ++i) {
        session.representations.push_back(representation_of('r' + std::to_string(i), mrr, 14));
    }
    return session;
}

Expected<ResolutionPlan> plan_in(const SessionSnapshot& session, const ResolutionRequest& request) {
    const auto found = find_requested(session, request);
    if (!found) return found.error();
    return plan_resolution(*found, request);
}

ResolutionPlan plan(std::uint32_t held, std::uint32_t wanted, std::uint32_t resume_from = 0) {
    const Expected<ResolutionPlan> made = plan_in(session_with(1), {"r1", held, wanted, resume_from});
    EXPECT_TRUE(made) << made.error().message;
    return made ? *made : ResolutionPlan{};
}

TEST(ResolutionTest, WhoHoldsNothingGetsTheBaseAndAllRecords) {
    const ResolutionPlan p = plan(0, 14);
    EXPECT_TRUE(p.with_base);
    EXPECT_EQ(p.first_record, 0U);
    EXPECT_EQ(p.last_record, 15U);
    EXPECT_EQ(p.level, 5U);
}

TEST(ResolutionTest, WhoHoldsALevelGetsWhatIsMissing) {
    const ResolutionPlan p = plan(8, 14);
    EXPECT_FALSE(p.with_base);
    EXPECT_EQ(p.first_record, 6U);
    EXPECT_EQ(p.last_record, 15U);
}

/// A tetrahedron that splits `splits` times, each after `moves` moves.
SessionSnapshot session_of_splits(int splits, int moves, bool regions = false) {
    SessionSnapshot session;
    MultiresMesh mrr;
    mrr.base = test::tetrahedron();
    for (int split = 0; split < splits; ++split) {
        for (int move = 0; move < moves; ++move) mrr.records.push_back(VertexMove{0, Vec3(0, 0, split)});
        mrr.records.push_back(VertexSplit{0, 1, Vec3(0, 0, 0), Vec3(1, 1, split)});
    }
    if (regions) mrr.regions.resize(4 + 2 * static_cast<std::size_t>(splits), 1);
    session.representations.push_back(representation_of("r1", mrr, 14));
    return session;
}

TEST(ResolutionTest, AKeyframeIsTheMeshWhereItIsLessThanTheWay) {
    // A split takes 57 bytes and 29 more for each move, and makes the mesh 24 + 2 * 12 larger.
    const SessionSnapshot session = session_of_splits(100, 1);
    const auto plan_for = [&](std::uint32_t held, std::uint32_t wanted, bool keyframe) {
        return *plan_in(session, {"r1", held, wanted, 0, keyframe});
    };
    EXPECT_EQ(plan_for(0, 204, false).keyframe, nullptr);
    const ResolutionPlan from_nothing = plan_for(0, 204, true);
    ASSERT_NE(from_nothing.keyframe, nullptr);
    EXPECT_TRUE(from_nothing.with_base);
    EXPECT_EQ(from_nothing.first_record, 200U);
    EXPECT_EQ(from_nothing.last_record, 200U);
    EXPECT_EQ(*from_nothing.keyframe, mesh_at(from_nothing.levels->mrr(), 100));
    // 4 vertices, 4 faces and 100 times 48 bytes: 4944. Records of 57 splits and moves take 4902, of 58 4988.
    EXPECT_EQ(plan_for(4 + 2 * 43, 204, true).keyframe, nullptr);
    EXPECT_NE(plan_for(4 + 2 * 42, 204, true).keyframe, nullptr);
    EXPECT_EQ(plan_for(204, 204, true).keyframe, nullptr);
    EXPECT_EQ(plan_for(204, 8, true).keyframe, nullptr);
}

TEST(ResolutionTest, AKeyframeBringsRegionsAgain) {
    const SessionSnapshot bare = session_of_splits(100, 0), with = session_of_splits(100, 0, true);
    EXPECT_NE(plan_in(bare, {"r1", 4, 204, 0, true})->keyframe, nullptr);  // 4944 bytes against 5700
    EXPECT_EQ(plan_in(with, {"r1", 4, 204, 0, true})->keyframe, nullptr);  // and 816 of regions
    EXPECT_NE(plan_in(with, {"r1", 0, 204, 0, true})->keyframe, nullptr);  // which come either way
}

TEST(ResolutionTest, CoarserSendsNothing) {
    const ResolutionPlan p = plan(14, 8);
    EXPECT_FALSE(p.with_base);
    EXPECT_EQ(p.first_record, p.last_record);
    EXPECT_EQ(p.level, 2U);
}

TEST(ResolutionTest, OutOfRangeGivesTheNearest) {
    EXPECT_EQ(plan(0, 1000).level, 10U);
    EXPECT_EQ(plan(0, 1).level, 0U);
    EXPECT_EQ(plan(0, 15).level, 5U);
}

TEST(ResolutionTest, ResumesWhereAStreamBrokeOff) {
    const ResolutionPlan with_part = plan(0, 14, 4);
    EXPECT_FALSE(with_part.with_base) << "records come after the base mesh";
    EXPECT_EQ(with_part.first_record, 4U);
    EXPECT_EQ(with_part.last_record, 15U);
    EXPECT_EQ(plan(8, 14, 11).first_record, 11U);
    EXPECT_EQ(plan(8, 14, 4).first_record, 6U) << "what the client holds is not sent again";
    EXPECT_EQ(plan(8, 14, 17).last_record, 17U) << "nothing is missing";
}

TEST(ResolutionTest, RefusesToResumeBeyondTheLastRecord) {
    const Expected<ResolutionPlan> made = plan_in(session_with(1), {"", 0, 14, 31});
    ASSERT_FALSE(made);
    EXPECT_EQ(made.error().cause, Cause::kInvalidOption);
    EXPECT_EQ(made.error().field, "resume_from");
}

TEST(ResolutionTest, NamesTheNearestWhenWhatIsHeldIsNoLevel) {
    for (const auto& [held, nearest] : {std::pair{9U, "8"}, std::pair{3U, "4"}, std::pair{26U, "24"}}) {
        const Expected<ResolutionPlan> made = plan_in(session_with(1), {"", held, 14, 0});
        ASSERT_FALSE(made) << held;
        EXPECT_EQ(made.error().cause, Cause::kInvalidOption);
        EXPECT_EQ(made.error().field, "faces_held");
        EXPECT_THAT(made.error().message, HasSubstr(std::string("the nearest is ") + nearest + " "));
    }
}

TEST(ResolutionTest, TakesTheNewestUnlessToldOtherwise) {
    const SessionSnapshot session = session_with(2);
    EXPECT_EQ(plan_in(session, {"", 0, 14, 0})->representation->id(), "r2");
    EXPECT_EQ(plan_in(session, {"r1", 0, 14, 0})->representation->id(), "r1");
    EXPECT_EQ(plan_in(session, {"r3", 0, 14, 0}).error().cause, Cause::kNotFound);
    EXPECT_EQ(plan_in(session_with(0), {"", 0, 14, 0}).error().cause, Cause::kNotReady);
}

TEST(ResolutionTest, OpenMeshesHaveOddNumbersOfFacesToo) {
    MultiresMesh mrr;
    mrr.base = test::tetrahedron();
    mrr.ghosts = 1;
    mrr.ghost_faces = 3;
    for (int split = 0; split < 4; ++split) mrr.records.push_back(VertexSplit{});
    mrr.border_splits = {0, 2};
    SessionSnapshot session;
    session.representations.push_back(representation_of("r1", mrr, 7));
    const Expected<ResolutionPlan> made = plan_in(session, {"", 2, 5, 0});  // 1 2 4 5 7 faces
    ASSERT_TRUE(made) << made.error().message;
    EXPECT_EQ(made->first_record, 1U);
    EXPECT_EQ(made->last_record, 3U);
    const Expected<ResolutionPlan> none = plan_in(session, {"", 6, 7, 0});
    ASSERT_FALSE(none);
    EXPECT_THAT(none.error().message, HasSubstr("the nearest is 5 (it has 1 to 7 in steps of 1 or 2"));
}

}  // namespace
}  // namespace vsplit::service

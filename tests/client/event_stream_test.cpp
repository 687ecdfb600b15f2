#include "event_stream.h"

#include <gtest/gtest.h>

#include "tests/client/some_mrr.h"
#include "vsplit/client/mesh_receiver.h"
#include "vsplit/mrr/record_block.h"
#include "wire/convert.h"

namespace vsplit::client {
namespace {

v1::ProgressiveEvent base_event(const TriangleMesh& mesh, std::size_t part) {
    v1::ProgressiveEvent event;
    *event.mutable_base_mesh() = wire::base_mesh_part(mesh, part);
    return event;
}

v1::ProgressiveEvent block_event(const MultiresMesh& mrr, std::uint32_t first, std::uint32_t count) {
    v1::ProgressiveEvent event;
    *event.mutable_record_block() =
        wire::to_proto(encode_block(mrr.records.slice(first, count), first, RecordEncoding::kFloat64));
    return event;
}

v1::ProgressiveEvent last_event(const std::string& id) {
    v1::ProgressiveEvent event;
    event.mutable_representation()->set_id(id);
    return event;
}

class EventStreamTest : public testing::Test {
protected:
    MultiresMesh mrr_ = test::some_mrr(30);
    MeshReceiver receiver_;
    int progress_ = 0;
    EventHandlers handlers_ = receiver_.handlers([this](const v1::Progress&) { ++progress_; });
    EventStream stream_{handlers_};
};

TEST_F(EventStreamTest, HandsOnWhatComes) {
    v1::ProgressiveEvent progress;
    progress.mutable_progress()->set_stage("simplify");
    ASSERT_TRUE(stream_.take(progress));
    ASSERT_TRUE(stream_.take(base_event(mrr_.base, 0)));
    ASSERT_TRUE(stream_.take(base_event(mrr_.base, 1)));
    ASSERT_TRUE(stream_.take(block_event(mrr_, 0, 10)));
    ASSERT_TRUE(stream_.take(block_event(mrr_, 10, 30)));
    ASSERT_TRUE(stream_.take(last_event("r")));
    const Expected<v1::Representation> made = stream_.finish();
    ASSERT_TRUE(made);
    EXPECT_EQ(made->id(), "r");
    EXPECT_EQ(progress_, 1);
    EXPECT_EQ(receiver_.held(), mrr_);
}

TEST_F(EventStreamTest, SkipsWhatNobodyHears) {
    const EventHandlers none;
    EventStream deaf(none);
    ASSERT_TRUE(deaf.take(base_event(mrr_.base, 0)));
    ASSERT_TRUE(deaf.take(base_event(mrr_.base, 1)));
    ASSERT_TRUE(deaf.take(block_event(mrr_, 0, 10)));
    ASSERT_TRUE(deaf.take(v1::ProgressiveEvent()));
    ASSERT_TRUE(deaf.take(last_event("r")));
    EXPECT_TRUE(deaf.finish());
}

TEST_F(EventStreamTest, AStreamMustEndWithARepresentation) {
    EXPECT_EQ(stream_.finish().error().cause, Cause::kCorrupt);
    ASSERT_TRUE(stream_.take(base_event(mrr_.base, 0)));
    EXPECT_EQ(stream_.finish().error().cause, Cause::kCorrupt);
    ASSERT_TRUE(stream_.take(last_event("r")));
    EXPECT_EQ(stream_.finish().error().cause, Cause::kCorrupt);  // half a base mesh
}

TEST_F(EventStreamTest, NothingFollowsTheRepresentation) {
    ASSERT_TRUE(stream_.take(last_event("r")));
    EXPECT_EQ(stream_.take(last_event("s")).error().cause, Cause::kOutOfOrder);
}

TEST_F(EventStreamTest, RecordsWaitForTheBaseMesh) {
    EXPECT_EQ(stream_.take(block_event(mrr_, 0, 10)).error().cause, Cause::kOutOfOrder);
    ASSERT_TRUE(stream_.take(base_event(mrr_.base, 0)));
    EXPECT_EQ(stream_.take(block_event(mrr_, 0, 10)).error().cause, Cause::kOutOfOrder);
}

TEST_F(EventStreamTest, ADamagedBlockIsCorrupt) {
    ASSERT_TRUE(stream_.take(base_event(mrr_.base, 0)));
    ASSERT_TRUE(stream_.take(base_event(mrr_.base, 1)));
    v1::ProgressiveEvent damaged = block_event(mrr_, 0, 10);
    (*damaged.mutable_record_block()->mutable_payload())[5] ^= 1;
    EXPECT_EQ(stream_.take(damaged).error().cause, Cause::kCorrupt);
    v1::ProgressiveEvent lying = block_event(mrr_, 0, 10);
    lying.mutable_record_block()->set_count(4'000'000'000U);
    EXPECT_EQ(stream_.take(lying).error().cause, Cause::kCorrupt);
    EXPECT_EQ(receiver_.faces_held(), mrr_.faces_min());
}

}  // namespace
}  // namespace vsplit::client

#include "vsplit/mrr/records.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/core/random.h"
#include "vsplit/mrr/multires_mesh.h"

namespace vsplit::test {
namespace {

std::vector<Record> random_records(std::size_t count, std::uint64_t seed) {
    Random random(seed);
    std::vector<Record> records;
    for (std::size_t n = 0; n < count; ++n) {
        const auto number = static_cast<std::uint32_t>(n);
        const std::uint32_t kind = random.below(10);
        if (kind < 4) records.emplace_back(VertexSplit{number, 1, Vec3(number, 0, 0), Vec3(0, number, 0)});
        if (kind >= 4 && kind < 7) records.emplace_back(EdgeFlip{number});
        if (kind >= 7) records.emplace_back(VertexMove{number, Vec3(0, 0, number)});
    }
    return records;
}

RecordList list_of(const std::vector<Record>& records) {
    RecordList list;
    for (const Record& record : records) list.push_back(record);
    return list;
}

TEST(RecordListTest, AnyRunIsWhatWasPutThere) {
    const std::vector<Record> records = random_records(3000, 1);
    const RecordList list = list_of(records);
    ASSERT_EQ(list.size(), records.size());
    Random random(2);
    for (int n = 0; n < 300; ++n) {
        const std::size_t first = n == 0 ? 0 : random.below(3001);
        const std::size_t count = n == 0 ? 3000 : random.below(static_cast<std::uint32_t>(3001 - first));
        const RecordSpan run = list.slice(first, count);
        ASSERT_TRUE(run.consistent());
        ASSERT_EQ(run.size(), count);
        RecordList expected;
        for (std::size_t at = first; at < first + count; ++at) expected.push_back(records[at]);
        RecordList got;
        got.append(run);
        ASSERT_EQ(got, expected) << first << " " << count;
    }
    for (std::size_t at = 0; at < records.size(); at += 37) EXPECT_EQ(list[at], records[at]);
}

TEST(RecordListTest, AppendingRunsGivesTheWhole) {
    const RecordList whole = list_of(random_records(2000, 3));
    Random random(4);
    RecordList list;
    while (list.size() < whole.size()) {
        const auto left = static_cast<std::uint32_t>(whole.size() - list.size());
        list.append(whole.slice(list.size(), std::min(left, random.below(700))));
    }
    EXPECT_EQ(list, whole);
}

TEST(RecordListTest, FindsEverySplit) {
    for (const std::uint64_t seed : {5, 6}) {
        const std::vector<Record> records = random_records(2500, seed);
        MultiresMesh mrr;
        mrr.records = list_of(records);
        std::size_t split = 0;
        EXPECT_EQ(mrr.record_of_level(0), 0U);
        for (std::size_t n = 0; n < records.size(); ++n) {
            if (!std::holds_alternative<VertexSplit>(records[n])) continue;
            ASSERT_EQ(mrr.records.record_of_split(split), n);
            ASSERT_EQ(mrr.record_of_level(++split), n + 1);
        }
        EXPECT_EQ(split, mrr.levels());
    }
    RecordList rare;  // a split many marks after the last
    for (int n = 0; n < 2000; ++n) rare.push_back(EdgeFlip{1});
    rare.push_back(VertexSplit{});
    EXPECT_EQ(rare.record_of_split(0), 2000U);
}

TEST(RecordSpanTest, ConsistentMeansThatTheArraysFit) {
    const RecordList list{VertexSplit{}, EdgeFlip{1}, VertexMove{}};
    RecordSpan span = list;
    EXPECT_TRUE(span.consistent());
    span.flips = {};
    EXPECT_FALSE(span.consistent());
    const std::vector<RecordKind> unknown{RecordKind{3}};
    EXPECT_FALSE((RecordSpan{unknown, {}, {}, {}}.consistent()));
    EXPECT_TRUE(RecordSpan().consistent());
}

TEST(MultiresMeshTest, FacesCountWhatIsVisible) {
    MultiresMesh mrr;
    mrr.base.faces.resize(20);
    mrr.ghosts = 1;
    mrr.ghost_faces = 5;
    for (int n = 0; n < 10; ++n) mrr.records.push_back(VertexSplit{});
    mrr.border_splits = {0, 3, 4};
    const std::vector<std::uint32_t> faces{15, 16, 18, 20, 21, 22, 24, 26, 28, 30, 32};
    for (std::size_t level = 0; level < faces.size(); ++level) {
        EXPECT_EQ(mrr.faces_at(level), faces[level]);
        EXPECT_EQ(mrr.level_for(faces[level]), level);
    }
    EXPECT_EQ(mrr.faces_min(), 15U);
    EXPECT_EQ(mrr.faces_max(), 32U);
    EXPECT_EQ(mrr.level_for(0), 0U);
    EXPECT_EQ(mrr.level_for(17), 1U);
    EXPECT_EQ(mrr.level_for(23), 5U);
    EXPECT_EQ(mrr.level_for(1000), 10U);
}

}  // namespace
}  // namespace vsplit::test

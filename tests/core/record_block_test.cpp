#include "vsplit/mrr/record_block.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/core/random.h"

namespace vsplit::test {
namespace {

std::vector<VertexSplit> random_splits(std::size_t count, std::uint64_t seed) {
    Random random(seed);
    std::vector<VertexSplit> splits(count);
    const auto point = [&] { return Vec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)); };
    for (VertexSplit& split : splits) split = {random.below(1U << 31U), random.below(100), point(), point()};
    return splits;
}

RecordBlock block_of(std::size_t count) { return encode_block(random_splits(count, 3), 17, RecordEncoding::kFloat64); }

void expect_corrupt(const RecordBlock& block, const std::string& what) {
    const Expected<std::vector<VertexSplit>> splits = decode_block(block);
    ASSERT_FALSE(splits) << what;
    EXPECT_EQ(splits.error().cause, Cause::kCorrupt) << what;
    EXPECT_NE(splits.error().message.find(std::to_string(block.first)), std::string::npos) << splits.error().message;
}

TEST(RecordBlockTest, Crc32cOfTheCheckString) {
    // The check value of CRC-32C, and of RFC 3720 B.4.
    const std::string digits = "123456789";
    EXPECT_EQ(crc32c(std::as_bytes(std::span(digits))), 0xE3069283U);
    EXPECT_EQ(crc32c(std::vector<std::byte>(32, std::byte{0})), 0x8A9136AAU);
    EXPECT_EQ(crc32c(std::vector<std::byte>(32, std::byte{0xFF})), 0x62A8AB43U);
    EXPECT_EQ(crc32c({}), 0U);
}

TEST(RecordBlockTest, GoldenBytes) {
    const std::vector<VertexSplit> splits = {{1, 2, {0.5, 0, 0}, {-2, 0, 1}}, {0x01020304, 3, {0, 0, 0}, {0, 0, 1}}};
    const RecordBlock block = encode_block(splits, 5, RecordEncoding::kFloat64);
    std::string expected;
    expected.append("\x01\0\0\0\x04\x03\x02\x01", 8);                                            // anchors
    expected.append("\x02\0\0\0\x03\0\0\0", 8);                                                  // steps
    expected.append("\0\0\0\0\0\0\xE0\x3F", 8).append(40, '\0');                                 // kept
    expected.append("\0\0\0\0\0\0\0\xC0", 8).append(8, '\0').append("\0\0\0\0\0\0\xF0\x3F", 8);  // added
    expected.append(16, '\0').append("\0\0\0\0\0\0\xF0\x3F", 8);
    EXPECT_EQ(block.payload, expected);
    EXPECT_EQ(block.first, 5U);
    EXPECT_EQ(block.count, 2U);
    EXPECT_EQ(block.crc32c, crc32c(std::as_bytes(std::span(expected))));
}

TEST(RecordBlockTest, DecodesWhatItEncoded) {
    for (const std::size_t count :
         {std::size_t{0}, std::size_t{1}, std::size_t{1000}, std::size_t{splits_per_block(RecordEncoding::kFloat64)}}) {
        const std::vector<VertexSplit> splits = random_splits(count, count);
        const Expected<std::vector<VertexSplit>> decoded = decode_block(encode_block(splits, 3, RecordEncoding::kFloat64));
        ASSERT_TRUE(decoded);
        EXPECT_EQ(*decoded, splits);
    }
}

TEST(RecordBlockTest, KeepsEveryBitOfADouble) {
    const std::vector<VertexSplit> splits = {
        {0, 1, {-0.0, 5e-324, std::numeric_limits<double>::max()}, {std::nan(""), -1.0 / 3, 0}}};
    const Expected<std::vector<VertexSplit>> decoded = decode_block(encode_block(splits, 0, RecordEncoding::kFloat64));
    ASSERT_TRUE(decoded);
    EXPECT_TRUE(std::signbit((*decoded)[0].kept.x()));
    EXPECT_EQ((*decoded)[0].kept, splits[0].kept);
    EXPECT_TRUE(std::isnan((*decoded)[0].added.x()));
    EXPECT_EQ((*decoded)[0].added.y(), -1.0 / 3);
}

TEST(RecordBlockTest, FullBlockFitsTheLimit) {
    const std::uint32_t full = splits_per_block(RecordEncoding::kFloat64);
    EXPECT_LE(block_of(full).payload.size(), kMaxBlockBytes);
    EXPECT_GT(block_of(full).payload.size() + 56, kMaxBlockBytes);
}

TEST(RecordBlockTest, AnyChangedByteIsCorrupt) {
    const RecordBlock block = block_of(4);
    for (std::size_t i = 0; i < block.payload.size(); ++i) {
        RecordBlock changed = block;
        changed.payload[i] = static_cast<char>(changed.payload[i] ^ 0x10);
        expect_corrupt(changed, "byte " + std::to_string(i));
    }
}

TEST(RecordBlockTest, ChangedFieldsAreCorrupt) {
    const auto changed = [](auto change) {
        RecordBlock block = block_of(4);
        change(block);
        return block;
    };
    expect_corrupt(changed([](RecordBlock& block) { block.count = 3; }), "count too small");
    expect_corrupt(changed([](RecordBlock& block) { block.count = 5; }), "count too large");
    expect_corrupt(changed([](RecordBlock& block) { block.count = 0xFFFFFFFF; }), "count of 4 billion");
    // 56 * 2^29 is a multiple of 2^32: to 32-bit arithmetic the size looks right.
    expect_corrupt(changed([](RecordBlock& block) { block.count = 4 + (1U << 29U); }), "count that wraps");
    expect_corrupt(changed([](RecordBlock& block) { block.payload.pop_back(); }), "payload cut");
    expect_corrupt(changed([](RecordBlock& block) { block.payload += '\0'; }), "payload too long");
    expect_corrupt(changed([](RecordBlock& block) { block.crc32c ^= 1; }), "checksum");
    expect_corrupt(changed([](RecordBlock& block) { block.encoding = RecordEncoding{0}; }), "encoding 0");
    expect_corrupt(changed([](RecordBlock& block) { block.encoding = RecordEncoding{99}; }), "encoding 99");
    expect_corrupt(changed([](RecordBlock& block) { block.first = 0xFFFFFFFE; }), "split numbers beyond 32 bits");
}

TEST(RecordBlockTest, PayloadBeyondTheLimitIsCorrupt) {
    RecordBlock block;
    block.count = splits_per_block(RecordEncoding::kFloat64) + 1;
    block.payload.assign(block.count * std::size_t{56}, '\0');
    block.crc32c = crc32c(std::as_bytes(std::span(block.payload)));
    expect_corrupt(block, "one split too many");
}

}  // namespace
}  // namespace vsplit::test

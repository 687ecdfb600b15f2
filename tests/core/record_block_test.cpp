#include "vsplit/mrr/record_block.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/core/random.h"

namespace vsplit::test {
namespace {

/// Records of all kinds, the splits first among equals.
RecordList random_records(std::size_t count, std::uint64_t seed) {
    Random random(seed);
    RecordList records;
    const auto point = [&] { return Vec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)); };
    while (records.size() < count) {
        const std::uint32_t kind = random.below(4);
        if (kind < 2) records.push_back(VertexSplit{random.below(1U << 31U), random.below(100), point(), point()});
        if (kind == 2) records.push_back(EdgeFlip{random.below(1U << 31U)});
        if (kind == 3) records.push_back(VertexMove{random.below(1U << 31U), point()});
    }
    return records;
}

RecordList splits(std::size_t count) {
    RecordList records;
    for (std::size_t n = 0; n < count; ++n) records.push_back(VertexSplit{1, 1, Vec3::Zero(), Vec3::Zero()});
    return records;
}

RecordBlock block_of(std::size_t count) { return encode_block(random_records(count, 3), 17, RecordEncoding::kFloat64); }

void expect_corrupt(const RecordBlock& block, const std::string& what) {
    const Expected<RecordList> records = decode_block(block);
    ASSERT_FALSE(records) << what;
    EXPECT_EQ(records.error().cause, Cause::kCorrupt) << what;
    EXPECT_NE(records.error().message.find(std::to_string(block.first)), std::string::npos) << records.error().message;
}

TEST(RecordBlockTest, MemoryOfABlockBeforeLeavesNoTrace) {
    const RecordList records{VertexMove{1, {1, 2, 3}}, VertexSplit{3, 1, {1, 2, 3}, {4, 5, 6}}};
    const RecordBlock fresh = encode_block(records, 7, RecordEncoding::kFloat64);
    for (const std::size_t size : {1U, 100U, 100'000U}) {
        const RecordBlock again = encode_block(records, 7, RecordEncoding::kFloat64, std::string(size, 'x'));
        EXPECT_EQ(again.payload, fresh.payload);
        EXPECT_EQ(again.crc32c, fresh.crc32c);
    }
}

TEST(RecordBlockTest, Crc32cOfTheCheckString) {
    // The check value of CRC-32C, and of RFC 3720 B.4.
    const std::string digits = "123456789";
    EXPECT_EQ(crc32c(std::as_bytes(std::span(digits))), 0xE3069283U);
    EXPECT_EQ(crc32c(std::vector<std::byte>(32, std::byte{0})), 0x8A9136AAU);
    EXPECT_EQ(crc32c(std::vector<std::byte>(32, std::byte{0xFF})), 0x62A8AB43U);
    EXPECT_EQ(crc32c({}), 0U);
    // Bit by bit, for lengths that are no multiple of what is taken at once.
    Random random(3);
    std::vector<std::byte> bytes;
    std::uint32_t crc = 0xFFFFFFFFU;
    for (int length = 1; length < 300; ++length) {
        bytes.push_back(static_cast<std::byte>(random.below(256)));
        crc ^= static_cast<std::uint32_t>(bytes.back());
        for (int bit = 0; bit < 8; ++bit) crc = crc >> 1U ^ ((crc & 1U) != 0 ? 0x82F63B78U : 0U);
        ASSERT_EQ(crc32c(bytes), ~crc) << length;
        const auto [front, rest] =
            std::pair(std::span(bytes).first(bytes.size() / 3), std::span(bytes).subspan(bytes.size() / 3));
        ASSERT_EQ(crc32c(rest, crc32c(front)), ~crc) << length;
        ASSERT_EQ(crc32c(std::span(bytes).subspan(bytes.size() / 2)),
                  crc32c(std::vector(bytes.begin() + length / 2, bytes.end())));
    }
}

TEST(RecordBlockTest, GoldenBytes) {
    const RecordList records{VertexSplit{1, 2, {0.5, 0, 0}, {-2, 0, 1}}, EdgeFlip{0x0A0B0C0D}, VertexMove{7, {0, -2, 1}},
                             VertexSplit{0x01020304, 3, {0, 0, 0}, {0, 0, 1}}};
    const RecordBlock block = encode_block(records, 5, RecordEncoding::kFloat64);
    std::string expected;
    expected.append("\0\x01\x02\0", 4).append(4, '\0');                                          // kinds
    expected.append("\x01\0\0\0\x04\x03\x02\x01", 8);                                            // anchors
    expected.append("\x02\0\0\0\x03\0\0\0", 8);                                                  // steps
    expected.append("\0\0\0\0\0\0\xE0\x3F", 8).append(40, '\0');                                 // kept
    expected.append("\0\0\0\0\0\0\0\xC0", 8).append(8, '\0').append("\0\0\0\0\0\0\xF0\x3F", 8);  // added
    expected.append(16, '\0').append("\0\0\0\0\0\0\xF0\x3F", 8);
    expected.append(8, '\0').append("\0\0\0\0\0\0\0\xC0", 8).append("\0\0\0\0\0\0\xF0\x3F", 8);  // position
    expected.append("\x0D\x0C\x0B\x0A", 4);                                                      // half-edge
    expected.append("\x07\0\0\0", 4);                                                            // vertex
    EXPECT_EQ(block.payload, expected);
    EXPECT_EQ(block.first, 5U);
    EXPECT_EQ(block.count, 4U);
    EXPECT_EQ(block.crc32c, crc32c(std::as_bytes(std::span(expected))));
}

TEST(RecordBlockTest, DecodesWhatItEncoded) {
    for (const std::size_t count : {0, 1, 7, 8, 9, 1000, 5000}) {
        const RecordList records = random_records(count, count);
        const Expected<RecordList> decoded = decode_block(encode_block(records, 3, RecordEncoding::kFloat64));
        ASSERT_TRUE(decoded);
        EXPECT_EQ(*decoded, records);
    }
}

TEST(RecordBlockTest, KeepsEveryBitOfADouble) {
    const RecordList records{VertexSplit{0, 1, {-0.0, 5e-324, std::numeric_limits<double>::max()}, {std::nan(""), -1.0 / 3, 0}},
                             VertexMove{0, {-0.0, 5e-324, 0}}};
    const Expected<RecordList> decoded = decode_block(encode_block(records, 0, RecordEncoding::kFloat64));
    ASSERT_TRUE(decoded);
    const VertexSplit& split = decoded->splits()[0];
    EXPECT_TRUE(std::signbit(split.kept.x()));
    EXPECT_EQ(split.kept, records.splits()[0].kept);
    EXPECT_TRUE(std::isnan(split.added.x()));
    EXPECT_EQ(split.added.y(), -1.0 / 3);
    EXPECT_TRUE(std::signbit(decoded->moves()[0].position.x()));
    EXPECT_EQ(decoded->moves()[0], records.moves()[0]);
}

TEST(RecordBlockTest, AsManyFitAsTheLimitAllows) {
    EXPECT_EQ(records_that_fit(splits(10000), RecordEncoding::kFloat64), 4599U);
    EXPECT_EQ(encode_block(splits(4599), 0, RecordEncoding::kFloat64).payload.size(), kMaxBlockBytes);
    EXPECT_EQ(records_that_fit({}, RecordEncoding::kFloat64), 0U);
    const RecordList records = random_records(60000, 9);
    for (std::size_t first = 0; first < records.size();) {
        const RecordSpan left = records.slice(first, records.size() - first);
        const std::size_t count = records_that_fit(left, RecordEncoding::kFloat64);
        ASSERT_GT(count, 0U);
        const std::size_t bytes = encode_block(records.slice(first, count), 0, RecordEncoding::kFloat64).payload.size();
        EXPECT_LE(bytes, kMaxBlockBytes);
        if (count < left.size()) {
            EXPECT_GT(bytes + 57 + 7, kMaxBlockBytes);
        }
        first += count;
    }
}

TEST(RecordBlockTest, BytesOfARecordAreThoseItAdds) {
    const auto bytes_of_8 = [](const auto& record) {
        RecordList records;
        for (int n = 0; n < 8; ++n) records.push_back(record);
        return encode_block(records, 0, RecordEncoding::kFloat64).payload.size();
    };
    EXPECT_EQ(bytes_of_8(VertexSplit{}), 8 * record_bytes(RecordKind::kSplit));
    EXPECT_EQ(bytes_of_8(EdgeFlip{}), 8 * record_bytes(RecordKind::kFlip));
    EXPECT_EQ(bytes_of_8(VertexMove{}), 8 * record_bytes(RecordKind::kMove));
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
    expect_corrupt(changed([](RecordBlock& block) { block.payload.pop_back(); }), "payload cut");
    expect_corrupt(changed([](RecordBlock& block) { block.payload += '\0'; }), "payload too long");
    expect_corrupt(changed([](RecordBlock& block) { block.payload.clear(); }), "no payload");
    expect_corrupt(changed([](RecordBlock& block) { block.crc32c ^= 1; }), "checksum");
    expect_corrupt(changed([](RecordBlock& block) { block.encoding = RecordEncoding{0}; }), "encoding 0");
    expect_corrupt(changed([](RecordBlock& block) { block.encoding = RecordEncoding{99}; }), "encoding 99");
    expect_corrupt(changed([](RecordBlock& block) { block.first = 0xFFFFFFFE; }), "record numbers beyond 32 bits");
}

TEST(RecordBlockTest, KindsThatLieAreCorrupt) {
    const auto with_byte = [](std::size_t at, char value) {
        RecordBlock block = encode_block(RecordList{VertexSplit{}, EdgeFlip{}, VertexMove{}}, 17, RecordEncoding::kFloat64);
        block.payload[at] = value;
        block.crc32c = crc32c(std::as_bytes(std::span(block.payload)));
        return block;
    };
    EXPECT_TRUE(decode_block(with_byte(0, 0)));
    expect_corrupt(with_byte(0, 3), "unknown kind");
    expect_corrupt(with_byte(2, '\xFF'), "unknown kind");
    expect_corrupt(with_byte(0, 1), "two flips have no bytes of a split");
    expect_corrupt(with_byte(1, 2), "two moves take more");
    expect_corrupt(with_byte(3, 1), "filled with something");
    expect_corrupt(with_byte(7, 1), "filled with something");
}

TEST(RecordBlockTest, PayloadBeyondTheLimitIsCorrupt) {
    RecordBlock block;
    block.count = 4600;
    block.payload.assign(block.count * std::size_t{57}, '\0');
    block.crc32c = crc32c(std::as_bytes(std::span(block.payload)));
    expect_corrupt(block, "one split too many");
}

}  // namespace
}  // namespace vsplit::test

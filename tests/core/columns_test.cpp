#include "mrr/columns.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/core/random.h"

namespace vsplit::test {
namespace {

struct Piece {
    std::uint32_t value = 0;
    unsigned width = 0;
};

/// Of all widths, more often short ones.
std::vector<Piece> random_pieces(std::size_t count) {
    Random random(3);
    std::vector<Piece> pieces;
    for (std::size_t n = 0; n < count; ++n) {
        const unsigned width = random.below(2) == 0 ? random.below(8) : random.below(33);
        const std::uint64_t most = std::uint64_t{1} << width;
        const std::uint64_t value = (std::uint64_t{random.below(1U << 16U)} << 16U | random.below(1U << 16U)) % most;
        pieces.push_back({static_cast<std::uint32_t>(value), width});
    }
    return pieces;
}

constexpr std::size_t kMost = 1U << 20U;

TEST(ColumnsTest, BitsComeBackWhateverTheirWidths) {
    for (const std::size_t count : {1, 2, 3, 10, 5000}) {
        const std::vector<Piece> pieces = random_pieces(count);
        ColumnWriter writer;
        for (const Piece& piece : pieces) writer.bits(column::kBits, piece.value, piece.width);
        std::string payload;
        writer.pack(payload);
        ColumnReader reader;
        ASSERT_TRUE(reader.unpack(std::as_bytes(std::span(payload)), kMost));
        for (const Piece& piece : pieces) EXPECT_EQ(reader.bits(column::kBits, piece.width), piece.value);
        EXPECT_FALSE(reader.ran_short()) << count;
        EXPECT_TRUE(reader.all_read()) << count;
    }
}

TEST(ColumnsTest, NumbersComeBackWhateverTheirSize) {
    std::vector<std::uint32_t> numbers{0, 1, 15, 16, 0xFFFFFFFFU};
    for (unsigned bit = 4; bit < 32; ++bit) {
        for (const std::uint32_t beside : {0U, 1U, (1U << bit) - 1U}) numbers.push_back((1U << bit) + beside);
    }
    ColumnWriter writer;
    for (const std::uint32_t number : numbers) writer.number(column::kMoved, number);
    std::string payload;
    writer.pack(payload);
    ColumnReader reader;
    ASSERT_TRUE(reader.unpack(std::as_bytes(std::span(payload)), kMost));
    for (const std::uint32_t number : numbers) EXPECT_EQ(reader.number(column::kMoved), number);
    EXPECT_FALSE(reader.ran_short());
    EXPECT_TRUE(reader.all_read());
}

TEST(ColumnsTest, SymbolsBeyondTheLargestAndColumnsWithoutBitsRunShort) {
    for (const std::uint8_t symbol : std::initializer_list<std::uint8_t>{16, 239, 240, 255}) {
        ColumnWriter writer;
        writer.byte(column::kMoved, symbol);
        if (symbol > Token::kLargest) {
            for (int n = 0; n < 100; ++n) writer.bits(column::kBits, 0, 32);
        }
        std::string payload;
        writer.pack(payload);
        ColumnReader reader;
        ASSERT_TRUE(reader.unpack(std::as_bytes(std::span(payload)), kMost));
        static_cast<void>(reader.number(column::kMoved));
        EXPECT_TRUE(reader.ran_short()) << int{symbol};
    }
}

TEST(ColumnsTest, EveryBitThatIsLeftOverIsNoticed) {
    for (std::uint32_t bytes = 1; bytes < 20; ++bytes) {
        ColumnWriter writer;
        for (std::uint32_t n = 0; n < bytes; ++n) writer.bits(column::kBits, 0, 8);
        std::string payload;
        writer.pack(payload);
        ColumnReader reader;
        ASSERT_TRUE(reader.unpack(std::as_bytes(std::span(payload)), kMost));
        for (std::uint32_t bit = 0; bit + 8 <= 8 * bytes; ++bit) {
            EXPECT_FALSE(reader.all_read()) << bit << " of " << bytes << " bytes";
            static_cast<void>(reader.bits(column::kBits, 1));
        }
        EXPECT_TRUE(reader.all_read()) << "what is left fills up a byte";
        static_cast<void>(reader.bits(column::kBits, 7));
        EXPECT_FALSE(reader.ran_short());
        static_cast<void>(reader.bits(column::kBits, 1));
        EXPECT_TRUE(reader.ran_short());
    }
}

}  // namespace
}  // namespace vsplit::test

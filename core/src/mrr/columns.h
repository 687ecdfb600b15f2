#pragma once

#include <zstd.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/byte_order.h"
#include "vsplit/base/expected.h"

namespace vsplit {

/// Where the symbols of a compressed block go, a byte each: like stands by like, so that each column gets a code of its own.
/// docs/format.md numbers them.
namespace column {
inline constexpr unsigned kKinds = 0;
inline constexpr unsigned kPlace = 1;      // of a split: beside the one before, or the high part of a vertex's number
inline constexpr unsigned kOddPlace = 2;   // the same where the number has an odd number of bits
inline constexpr unsigned kMean = 3;       // how far points are from the mean of their ring, of those that are nearly there
inline constexpr unsigned kFan = 2;        // + valence 3 .. 10: which faces go over
inline constexpr unsigned kLargeFan = 13;  // of larger valences
inline constexpr unsigned kFlip = 14;      // high part of a half-edge
inline constexpr unsigned kMoved = 15;     // vertices of moves
inline constexpr unsigned kAlong = 16;     // + scale: coordinates along the surface
inline constexpr unsigned kAcross = 48;    // + scale: the coordinate across it
inline constexpr unsigned kMoveAlong = 80;
inline constexpr unsigned kMoveAcross = 112;
inline constexpr unsigned kCount = 144;
inline constexpr unsigned kBits = 144;       // bits that no code shortens, in the order they are read
inline constexpr unsigned kPlaceBits = 145;  // those of places: who decodes sees ahead where the next records are
inline constexpr unsigned kAll = 146;
}  // namespace column

/// Whole numbers as a byte and, beyond 15, bits: the byte says how many bits there are and which the first three are.
struct Token {
    std::uint8_t symbol = 0;
    std::uint8_t bits = 0;
    std::uint32_t rest = 0;

    [[nodiscard]] static Token of(std::uint32_t value) {
        if (value < 16) return {static_cast<std::uint8_t>(value), 0, 0};
        const unsigned top = 31U - static_cast<unsigned>(std::countl_zero(value));
        const unsigned bits = top - 3;
        const auto symbol = static_cast<std::uint8_t>(16 + (top - 4) * 8 + (value >> bits & 7U));
        return {symbol, static_cast<std::uint8_t>(bits), value & ((1U << bits) - 1)};
    }
    static constexpr std::uint8_t kLargest = 16 + 27 * 8 + 7;
};

/// The values of all symbols without their bits, for a reader that asks no symbol how large it is. Those beyond the largest want
/// more bits than there are anywhere.
struct TokenTable {
    struct Entry {
        std::uint32_t value = 0;
        std::uint32_t bits = 0;
    };
    std::array<Entry, 256> entries{};

    constexpr TokenTable() {
        for (unsigned symbol = 0; symbol < entries.size(); ++symbol) {
            const unsigned bits = symbol < 16 ? 0 : (symbol - 16) / 8 + 1;
            entries[symbol] = symbol < 16                ? Entry{symbol, 0}
                              : symbol > Token::kLargest ? Entry{0, 0xFFFFFFFFU}
                                                         : Entry{(8U | (symbol & 7U)) << bits, bits};
        }
    }
};
inline constexpr TokenTable kTokens;

/// In place of a number: the point is the mean of its ring but for what column::kMean says.
inline constexpr std::uint8_t kIsMean = 255;

/// Numbers with a sign as numbers without: 0, -1, 1, -2, 2 ...
[[nodiscard]] inline std::uint32_t to_zigzag(std::int32_t value) {
    return static_cast<std::uint32_t>(value) << 1U ^ static_cast<std::uint32_t>(value >> 31);
}
[[nodiscard]] inline std::int32_t from_zigzag(std::uint32_t value) {
    return static_cast<std::int32_t>(value >> 1U ^ (0U - (value & 1U)));
}

/// How a number below `count` is cut: a byte of at most 7 bits that gets a code, and the bits below it as they are.
[[nodiscard]] inline unsigned low_bits(std::uint32_t count) {
    const auto width = static_cast<unsigned>(std::bit_width(count - 1));
    return width > 7 ? width - 7 : 0;
}

/// Collects columns and packs them.
class ColumnWriter {
public:
    void byte(unsigned column, std::uint8_t symbol) { columns_[column].push_back(symbol); }
    /// Column kBits or kPlaceBits. \pre width <= 32, value < 2^width.
    void bits(unsigned column, std::uint32_t value, unsigned width) {
        Bits& to = bits_[column - column::kBits];
        to.pending |= std::uint64_t{value} << to.width;
        to.width += width;
        if (to.width >= 32) to.put(4);
    }
    void number(unsigned column, std::uint32_t value) {
        const Token token = Token::of(value);
        byte(column, token.symbol);
        bits(column::kBits, token.rest, token.bits);
    }
    void clear();

    /// Appends the columns that are not empty, each compressed by zstd where that is shorter, to `payload`.
    void pack(std::string& payload);

private:
    std::array<std::vector<std::uint8_t>, column::kCount> columns_;
    struct Bits {
        std::vector<std::uint8_t> packed;
        std::uint64_t pending = 0;
        unsigned width = 0;  ///< less than 32 before more come

        void put(unsigned bytes) {
            for (unsigned n = 0; n < bytes; ++n, pending >>= 8U) packed.push_back(static_cast<std::uint8_t>(pending & 0xFFU));
            width -= std::min(width, 8 * bytes);
        }
    };
    std::array<Bits, column::kAll - column::kBits> bits_;

    /// As short as it gets: `column` itself, or a zstd frame that is there until the next call.
    std::span<const std::uint8_t> compress(std::span<const std::uint8_t> column);
    std::vector<std::uint8_t> tried_, shortest_;
    struct Free {
        void operator()(ZSTD_CCtx* context) const { ZSTD_freeCCtx(context); }
    };
    std::unique_ptr<ZSTD_CCtx, Free> zstd_{ZSTD_createCCtx()};
};

/// Unpacks and gives the symbols back. Reading beyond the end of a column gives 0 and is remembered.
class ColumnReader {
public:
    /// \return CORRUPT, with what is wrong, when `payload` is no sequence of columns or would unpack to more than `most` bytes.
    [[nodiscard]] Status unpack(std::span<const std::byte> payload, std::size_t most);

    [[nodiscard]] std::uint8_t byte(unsigned column) {
        Cursor& at = columns_[column];
        if (at.next == at.end) [[unlikely]] {
            short_ = true;
            return 0;
        }
        return *at.next++;
    }
    /// Column kBits or kPlaceBits. \pre width <= 32.
    [[nodiscard]] std::uint32_t bits(unsigned column, unsigned width) {
        BitCursor& at = bits_[column - column::kBits];
        if (at.end - at.next < width) [[unlikely]] {
            short_ = true;
            return 0;
        }
        const auto word = load<std::uint64_t>(at.bytes + at.next / 8) >> at.next % 8;
        at.next += width;
        return static_cast<std::uint32_t>(word & ((std::uint64_t{1} << width) - 1));
    }
    [[nodiscard]] std::uint32_t number(unsigned column) {
        const TokenTable::Entry token = kTokens.entries[byte(column)];
        return token.value | bits(column::kBits, token.bits);
    }
    /// Whether the column's next symbol is this one; only then is it read.
    [[nodiscard]] bool skip(unsigned column, std::uint8_t symbol) {
        Cursor& at = columns_[column];
        if (at.next == at.end || *at.next != symbol) [[likely]]
            return false;
        ++at.next;
        return true;
    }
    /// All symbols of a column, which then are read.
    [[nodiscard]] std::span<const std::uint8_t> take(unsigned column) {
        const std::span all = rest(column);
        columns_[column].next = columns_[column].end;
        return all;
    }
    /// Symbols of a column that are left.
    [[nodiscard]] std::span<const std::uint8_t> rest(unsigned column) const {
        return {columns_[column].next, columns_[column].end};
    }

    /// Whether something was read that was not there.
    [[nodiscard]] bool ran_short() const { return short_; }
    /// Whether all that was there was read; bits that fill up the last byte are 0.
    [[nodiscard]] bool all_read() const;

private:
    struct Cursor {
        const std::uint8_t* next = nullptr;
        const std::uint8_t* end = nullptr;
    };
    /// `next` and `end` count bits; eight bytes can be read at each.
    struct BitCursor {
        const std::byte* bytes = nullptr;
        std::size_t next = 0;
        std::size_t end = 0;
    };

    std::array<Cursor, column::kCount> columns_{};
    std::array<BitCursor, column::kAll - column::kBits> bits_{};
    std::vector<std::uint8_t> unpacked_;
    bool short_ = false;
    struct Free {
        void operator()(ZSTD_DCtx* context) const { ZSTD_freeDCtx(context); }
    };
    std::unique_ptr<ZSTD_DCtx, Free> zstd_{ZSTD_createDCtx()};
};

}  // namespace vsplit

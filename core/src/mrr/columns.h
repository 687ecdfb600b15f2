#pragma once

#include <zstd.h>

#include <array>
#include <bit>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "vsplit/base/expected.h"

namespace vsplit {

/// Where the symbols of a compressed block go, a byte each: like stands by like, so that each column gets a code of its own.
/// docs/format.md numbers them.
namespace column {
inline constexpr unsigned kKinds = 0;
inline constexpr unsigned kPlace = 1;      // of a split: beside the one before, or the high part of a vertex's number
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
    /// How many bits follow a symbol.
    [[nodiscard]] static unsigned bits_after(std::uint8_t symbol) { return symbol < 16 ? 0 : (symbol - 16U) / 8 + 1; }
    [[nodiscard]] static std::uint32_t value(std::uint8_t symbol, std::uint32_t rest) {
        return symbol < 16 ? symbol : (8U | (symbol & 7U)) << bits_after(symbol) | rest;
    }
    static constexpr std::uint8_t kLargest = 16 + 27 * 8 + 7;
};

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
    void byte(unsigned column, std::uint8_t symbol) { columns_[column].push_back(static_cast<char>(symbol)); }
    /// Column kBits or kPlaceBits. \pre width <= 32, value < 2^width.
    void bits(unsigned column, std::uint32_t value, unsigned width);
    void number(unsigned column, std::uint32_t value);
    void clear();

    /// Appends the columns that are not empty, each compressed by zstd where that is shorter, to `payload`.
    void pack(std::string& payload);

private:
    std::array<std::string, column::kCount> columns_;
    struct Bits {
        std::string packed;
        std::uint64_t pending = 0;
        unsigned width = 0;
    };
    std::array<Bits, column::kAll - column::kBits> bits_;
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
        if (at.next == at.end) {
            short_ = true;
            return 0;
        }
        return *at.next++;
    }
    /// Column kBits or kPlaceBits. \pre width <= 32.
    [[nodiscard]] std::uint32_t bits(unsigned column, unsigned width) {
        Pending& pending = pending_[column - column::kBits];
        while (pending.width < width) {
            Cursor& at = columns_[column];
            std::uint64_t more = 0;
            if (at.next == at.end) {
                short_ = true;
            } else {
                more = *at.next++;
            }
            pending.bits |= more << pending.width;
            pending.width += 8;
        }
        const auto value = static_cast<std::uint32_t>(pending.bits & ((std::uint64_t{1} << width) - 1));
        pending.bits >>= width;
        pending.width -= width;
        return value;
    }
    [[nodiscard]] std::uint32_t number(unsigned column) {
        const std::uint8_t symbol = byte(column);
        return symbol < 16 ? symbol : large_number(symbol);
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
    [[nodiscard]] std::uint32_t large_number(std::uint8_t symbol) {
        if (symbol > Token::kLargest) short_ = true;
        return Token::value(symbol, bits(column::kBits, Token::bits_after(symbol)));
    }

    std::array<Cursor, column::kAll> columns_{};
    std::vector<std::uint8_t> unpacked_;
    struct Pending {
        std::uint64_t bits = 0;
        unsigned width = 0;
    };
    std::array<Pending, column::kAll - column::kBits> pending_{};
    bool short_ = false;
    struct Free {
        void operator()(ZSTD_DCtx* context) const { ZSTD_freeDCtx(context); }
    };
    std::unique_ptr<ZSTD_DCtx, Free> zstd_{ZSTD_createDCtx()};
};

}  // namespace vsplit

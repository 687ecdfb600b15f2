#pragma once

#include <cstdint>

#include "mrr/columns.h"

namespace vsplit {

/// Writes symbols. A coder that calls one of these two runs the same way in both directions, so that there is one description of
/// what is stored.
class SymbolWriter {
public:
    static constexpr bool kWrites = true;
    explicit SymbolWriter(ColumnWriter& columns) : columns_(columns) {}
    void byte(unsigned column, std::uint32_t& value) { columns_.byte(column, static_cast<std::uint8_t>(value)); }
    void bits(unsigned column, std::uint32_t& value, unsigned width) { columns_.bits(column, value, width); }
    void number(unsigned column, std::uint32_t& value) { columns_.number(column, value); }
    /// Whether kIsMean stands in place of a number.
    [[nodiscard]] bool mean(unsigned column, bool is_mean) {
        if (is_mean) columns_.byte(column, kIsMean);
        return is_mean;
    }
    [[nodiscard]] static bool ran_short() { return false; }

private:
    ColumnWriter& columns_;
};

/// Reads them.
class SymbolReader {
public:
    static constexpr bool kWrites = false;
    explicit SymbolReader(ColumnReader& columns) : columns_(columns) {}
    void byte(unsigned column, std::uint32_t& value) { value = columns_.byte(column); }
    void bits(unsigned column, std::uint32_t& value, unsigned width) { value = columns_.bits(column, width); }
    void number(unsigned column, std::uint32_t& value) { value = columns_.number(column); }
    [[nodiscard]] bool mean(unsigned column, bool /*is_mean*/) { return columns_.skip(column, kIsMean); }
    [[nodiscard]] bool ran_short() const { return columns_.ran_short(); }

private:
    ColumnReader& columns_;
};

/// A number below `count` of which any is as likely: 7 bits or fewer that get a code, the others as they are.
template <class Symbols>
void code_uniform(Symbols& symbols, unsigned column, std::uint32_t& value, std::uint32_t count) {
    const unsigned low = low_bits(count);
    std::uint32_t high = value >> low;
    std::uint32_t rest = value & ((1U << low) - 1);
    symbols.byte(column, high);
    symbols.bits(column::kBits, rest, low);
    value = high << low | rest;
}

/// A coordinate as the difference to what is expected, in numbers of the grid. \return false where there is no such number.
template <class Symbols, class Codes>
[[nodiscard]] bool code_coordinate(Symbols& symbols, const Codes& codes, unsigned column, double expected, unsigned axis,
                                   double& value) {
    const std::uint32_t guess = codes.code(expected, axis);
    std::uint32_t residual = 0;
    if constexpr (Symbols::kWrites) residual = to_zigzag(static_cast<std::int32_t>(codes.code(value, axis) - guess));
    symbols.number(column, residual);
    const std::uint32_t code = guess + static_cast<std::uint32_t>(from_zigzag(residual));
    if (!codes.holds(code)) return false;
    value = codes.value(code, axis);
    return true;
}

}  // namespace vsplit

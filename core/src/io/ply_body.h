#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "io/ply_header.h"
#include "io/text_lines.h"
#include "vsplit/base/expected.h"

namespace vsplit {

/// The rows of a binary PLY, number by number. Every number a PLY can hold is a double.
class PlyBinaryBody {
public:
    PlyBinaryBody(std::span<const std::byte> bytes, const PlyHeader& header);

    [[nodiscard]] Status begin_row() { return Done{}; }
    [[nodiscard]] Expected<double> read(PlyType type);
    /// Passes over `count` numbers.
    [[nodiscard]] Status skip(PlyType type, std::uint64_t count);
    [[nodiscard]] Status end_row() { return Done{}; }
    /// MALFORMED_INPUT when bytes are left.
    [[nodiscard]] Status end_file() const;

    [[nodiscard]] std::size_t left() const { return bytes_.size() - at_; }
    [[nodiscard]] Place place() const { return at_byte(at_); }

private:
    [[nodiscard]] Error truncated() const;

    std::span<const std::byte> bytes_;
    std::size_t at_;
    std::endian order_;
};

/// The rows of a PLY in text, each a line; with the same verbs.
class PlyTextBody {
public:
    PlyTextBody(std::span<const std::byte> bytes, const PlyHeader& header);

    [[nodiscard]] Status begin_row();
    [[nodiscard]] Expected<double> read(PlyType type);
    [[nodiscard]] Status skip(PlyType type, std::uint64_t count);
    [[nodiscard]] Status end_row();
    [[nodiscard]] Status end_file();

    /// What a last line without its end lacks is counted too.
    [[nodiscard]] std::size_t left() const { return lines_.rest().size() + 1; }
    [[nodiscard]] Place place() const { return at_line(header_lines_ + lines_.number()); }

private:
    TextLines lines_;
    std::string_view line_;
    std::size_t header_lines_;
};

}  // namespace vsplit

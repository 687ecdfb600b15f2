#include "io/ply_body.h"

#include <cmath>
#include <optional>
#include <string>

namespace vsplit {
PlyBinaryBody::PlyBinaryBody(std::span<const std::byte> bytes, const PlyHeader& header)
    : bytes_(bytes),
      at_(header.body_offset),
      order_(header.encoding == PlyEncoding::kBigEndian ? std::endian::big : std::endian::little) {}

Expected<double> PlyBinaryBody::read(PlyType type) {
    const std::size_t size = size_of(type);
    if (size > left()) return truncated();
    const double value = load_number(bytes_.data() + at_, type, order_);
    at_ += size;
    return value;
}

Status PlyBinaryBody::skip(PlyType type, std::uint64_t count) {
    if (count > left() / size_of(type)) return truncated();
    at_ += count * size_of(type);
    return Done{};
}

Status PlyBinaryBody::end_file() const {
    if (left() == 0) return Done{};
    return read_error(Cause::kMalformedInput, place(), std::to_string(left()) + " bytes follow the last announced row");
}

Error PlyBinaryBody::truncated() const { return read_error(Cause::kTruncatedInput, place(), "the file ends within a row"); }

PlyTextBody::PlyTextBody(std::span<const std::byte> bytes, const PlyHeader& header)
    : lines_(as_text(bytes.subspan(header.body_offset))), header_lines_(header.lines) {}

Status PlyTextBody::begin_row() {
    while (lines_.next()) {
        std::string_view rest = line_ = lines_.line();
        if (!next_word(rest).empty()) return Done{};
    }
    return read_error(Cause::kTruncatedInput, place(), "the file ends where a row should follow");
}

Expected<double> PlyTextBody::read(PlyType type) {
    const std::string_view word = next_word(line_);
    const std::optional<double> value = parse_number(word);
    if (!value || (is_integer(type) && std::trunc(*value) != *value)) {
        const std::string wanted = is_integer(type) ? "an integer" : "a number";
        const bool cut = word.empty() && lines_.rest().empty();
        return read_error(cut ? Cause::kTruncatedInput : Cause::kMalformedInput, place(),
                          "expected " + wanted + ", " + found(word));
    }
    return *value;
}

Status PlyTextBody::skip(PlyType type, std::uint64_t count) {
    for (std::uint64_t i = 0; i < count; ++i) {
        if (const Expected<double> value = read(type); !value) return value.error();
    }
    return Done{};
}

Status PlyTextBody::end_row() {
    const std::string_view word = next_word(line_);
    if (word.empty()) return Done{};
    return read_error(Cause::kMalformedInput, place(), "expected the row to end, " + found(word));
}

Status PlyTextBody::end_file() {
    while (lines_.next()) {
        std::string_view rest = lines_.line();
        const std::string_view word = next_word(rest);
        if (word.empty()) continue;
        return read_error(Cause::kMalformedInput, place(), "expected the file to end, " + found(word));
    }
    return Done{};
}

}  // namespace vsplit

#include "io/vtu_array.h"

#include <zlib.h>

#include <algorithm>
#include <optional>
#include <string>

#include "base/byte_order.h"

namespace vsplit {
namespace {

using Bytes = std::vector<std::byte>;

int digit_of(char c) {
    if (c >= 'A' && c <= 'Z') return c - 'A';
    if (c >= 'a' && c <= 'z') return c - 'a' + 26;
    if (c >= '0' && c <= '9') return c - '0' + 52;
    if (c == '+') return 62;
    return c == '/' ? 63 : -1;
}

/// Letters of base64 text, without the space that may stand between them.
class Letters {
public:
    explicit Letters(std::string_view text) : text_(text) {}

    /// The next one; 0 at the end.
    [[nodiscard]] char next() {
        constexpr std::string_view kSpace = " \t\r\n";
        while (at_ < text_.size() && kSpace.find(text_[at_]) != std::string_view::npos) ++at_;
        return at_ < text_.size() ? text_[at_++] : '\0';
    }
    [[nodiscard]] std::string_view rest() const { return text_.substr(at_); }

private:
    std::string_view text_;
    std::size_t at_ = 0;
};

/// The first `count` bytes of base64 text; empty where the text is too short or has another letter.
std::optional<Bytes> decode_base64(Letters& letters, std::size_t count) {
    const std::size_t quartets = (count + 2) / 3;
    if (letters.rest().size() / 4 < quartets) return {};
    Bytes bytes;
    bytes.reserve(3 * quartets);
    for (std::size_t q = 0; q < quartets; ++q) {
        std::uint32_t bits = 0;
        for (std::size_t i = 0; i < 4; ++i) {
            const char c = letters.next();
            const int digit = c == '=' && i >= 2 ? 0 : digit_of(c);
            if (digit < 0) return {};
            bits = bits << 6U | static_cast<std::uint32_t>(digit);
        }
        for (const unsigned shift : {16U, 8U, 0U}) bytes.push_back(static_cast<std::byte>(bits >> shift & 0xFFU));
    }
    bytes.resize(count);
    return bytes;
}

/// Takes runs of bytes off a text that holds them as base64, each run encoded on its own, or as they are.
class Runs {
public:
    Runs(std::string_view text, bool base64) : text_(text), base64_(base64) {}

    /// The first bytes without taking them.
    [[nodiscard]] std::optional<Bytes> peek(std::size_t count) const { return Runs(*this).take(count); }

    [[nodiscard]] std::optional<Bytes> take(std::size_t count) {
        if (base64_) {
            Letters letters(text_);
            std::optional<Bytes> bytes = decode_base64(letters, count);
            text_ = letters.rest();
            return bytes;
        }
        if (count > text_.size()) return {};
        const auto* from = reinterpret_cast<const std::byte*>(text_.data());
        text_.remove_prefix(count);
        return Bytes(from, from + count);
    }

private:
    std::string_view text_;
    bool base64_;
};

std::uint64_t length_at(const Bytes& bytes, std::size_t number, const VtuEncoding& e) {
    const std::byte* from = bytes.data() + number * e.header;
    return e.header == 8 ? load<std::uint64_t>(from, e.order) : load<std::uint32_t>(from, e.order);
}

Error short_array(Place place) {
    return read_error(Cause::kTruncatedInput, place, "an array ends before what its length announces, or is no base64");
}

Error long_array(Place place, std::uint64_t bytes, const VtuEncoding& e) {
    return read_error(
        Cause::kLimitExceeded, place,
        "an array announces " + std::to_string(bytes) + " bytes; at most " + std::to_string(e.most_bytes) + " are accepted");
}

Expected<Bytes> decode_plain(Runs runs, const VtuEncoding& e, Place place) {
    const std::optional<Bytes> header = runs.peek(e.header);
    if (!header) return short_array(place);
    const std::uint64_t length = length_at(*header, 0, e);
    if (length > e.most_bytes) return long_array(place, length, e);
    std::optional<Bytes> all = runs.take(e.header + length);
    if (!all) return short_array(place);
    all->erase(all->begin(), all->begin() + static_cast<std::ptrdiff_t>(e.header));
    return *std::move(all);
}

/// The header says how many blocks there are, how long they are uncompressed, the last of them, and compressed each.
Expected<Bytes> decode_blocks(Runs runs, const VtuEncoding& e, Place place) {
    const std::optional<Bytes> first = runs.peek(3 * e.header);
    if (!first) return short_array(place);
    const std::uint64_t blocks = length_at(*first, 0, e);
    const std::uint64_t size = length_at(*first, 1, e);
    const std::uint64_t last = length_at(*first, 2, e);
    if (blocks == 0) return Bytes();
    if (size > e.most_bytes || last > size || blocks > e.most_bytes / std::max<std::uint64_t>(1, size) + 1)
        return long_array(place, size, e);
    const std::optional<Bytes> header = runs.take((3 + blocks) * e.header);
    if (!header) return short_array(place);
    std::uint64_t compressed = 0;
    for (std::uint64_t b = 0; b < blocks; ++b) compressed += std::min(length_at(*header, 3 + b, e), std::uint64_t{1} << 40U);
    if (compressed > e.most_bytes) return long_array(place, compressed, e);
    const std::optional<Bytes> data = runs.take(compressed);
    if (!data) return short_array(place);
    Bytes all;
    const std::byte* from = data->data();
    for (std::uint64_t b = 0; b < blocks; ++b) {
        const std::uint64_t length = length_at(*header, 3 + b, e);
        const std::uint64_t expected = b + 1 == blocks && last != 0 ? last : size;
        const std::size_t before = all.size();
        all.resize(before + expected);
        uLongf made = expected;
        const int status = uncompress(reinterpret_cast<Bytef*>(all.data() + before), &made, reinterpret_cast<const Bytef*>(from),
                                      static_cast<uLong>(length));
        if (status != Z_OK || made != expected)
            return read_error(Cause::kMalformedInput, place, "block " + std::to_string(b) + " of an array is not zlib's");
        from += length;
    }
    return all;
}

}  // namespace

Expected<std::vector<std::byte>> decode_vtu_array(std::string_view bytes, bool base64, const VtuEncoding& encoding, Place place) {
    const Runs runs(bytes, base64);
    return encoding.zlib ? decode_blocks(runs, encoding, place) : decode_plain(runs, encoding, place);
}

}  // namespace vsplit

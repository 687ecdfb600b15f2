#include "mrr/columns.h"

#include <algorithm>
#include <cassert>

namespace vsplit {
namespace {

// There is little to find in most columns but how often each symbol comes: repetitions there are by chance and cost more than
// they save. Columns of regular parts do repeat themselves. So both is tried; higher levels gain little for their time.
struct Search {
    int least_match, hash_log;  // 0: as the level has it
};
constexpr int kZstdLevel = 1;
constexpr Search kSearches[] = {{0, 0}, {7, 6}};

void append_varint(std::string& to, std::size_t value) {
    for (; value >= 0x80; value >>= 7U) to.push_back(static_cast<char>(0x80U | (value & 0x7FU)));
    to.push_back(static_cast<char>(value));
}

Error corrupt(const std::string& what) { return {Cause::kCorrupt, what, ""}; }

/// Sizes of a payload, front to back.
class PayloadReader {
public:
    explicit PayloadReader(std::span<const std::byte> payload) : left_(payload) {}

    [[nodiscard]] bool at_end() const { return left_.empty(); }
    [[nodiscard]] std::size_t left() const { return left_.size(); }
    /// False at the end of the payload or beyond 32 bits.
    [[nodiscard]] bool varint(std::uint64_t& value) {
        value = 0;
        for (unsigned shift = 0; shift < 35 && !left_.empty(); shift += 7) {
            const auto byte = static_cast<std::uint8_t>(left_.front());
            left_ = left_.subspan(1);
            value |= std::uint64_t{byte & 0x7FU} << shift;
            if (byte < 0x80) return value >> 32U == 0;
        }
        return false;
    }
    [[nodiscard]] std::span<const std::byte> take(std::size_t size) {
        const auto taken = left_.first(size);
        left_ = left_.subspan(size);
        return taken;
    }

private:
    std::span<const std::byte> left_;
};

}  // namespace

void ColumnWriter::clear() {
    for (std::vector<std::uint8_t>& column : columns_) column.clear();
    for (Bits& bits : bits_) {
        bits.packed.clear();
        bits.pending = bits.width = 0;
    }
}

std::span<const std::uint8_t> ColumnWriter::compress(std::span<const std::uint8_t> column) {
    std::span<const std::uint8_t> shortest = column;
    for (const Search& search : kSearches) {
        ZSTD_CCtx_setParameter(zstd_.get(), ZSTD_c_compressionLevel, kZstdLevel);
        ZSTD_CCtx_setParameter(zstd_.get(), ZSTD_c_minMatch, search.least_match);
        ZSTD_CCtx_setParameter(zstd_.get(), ZSTD_c_hashLog, search.hash_log);
        tried_.resize(ZSTD_compressBound(column.size()));
        const std::size_t size = ZSTD_compress2(zstd_.get(), tried_.data(), tried_.size(), column.data(), column.size());
        if (ZSTD_isError(size) != 0U || size >= shortest.size()) continue;
        std::swap(tried_, shortest_);
        shortest = std::span(shortest_).first(size);
    }
    return shortest;
}

void ColumnWriter::pack(std::string& payload) {
    const auto put = [&payload](unsigned number, bool is_compressed, std::span<const std::uint8_t> bytes) {
        payload.push_back(static_cast<char>(number));
        append_varint(payload, bytes.size() * 2 + (is_compressed ? 1 : 0));
        payload.append(bytes.begin(), bytes.end());
    };
    for (unsigned c = 0; c < column::kCount; ++c) {
        if (columns_[c].empty()) continue;
        const std::span<const std::uint8_t> bytes = compress(columns_[c]);
        put(c, bytes.size() < columns_[c].size(), bytes);
    }
    for (unsigned c = column::kBits; c < column::kAll; ++c) {
        Bits& of = bits_[c - column::kBits];
        of.put((of.width + 7) / 8);
        if (!of.packed.empty()) put(c, false, of.packed);
    }
}

Status ColumnReader::unpack(std::span<const std::byte> payload, std::size_t most) {
    struct Stored {
        unsigned column = 0;
        bool compressed = false;
        std::span<const std::byte> bytes;
        std::size_t size = 0;
    };
    std::vector<Stored> stored;
    std::size_t total = 0;
    for (PayloadReader reader(payload); !reader.at_end();) {
        Stored next;
        next.column = static_cast<std::uint8_t>(reader.take(1).front());
        std::uint64_t size = 0;
        if (!reader.varint(size) || size / 2 > reader.left()) return corrupt("a column does not end where its block does");
        if (next.column >= column::kAll || (!stored.empty() && next.column <= stored.back().column))
            return corrupt("column " + std::to_string(next.column) + " where a higher one up to 145 is due");
        next.compressed = size % 2 != 0;
        next.bytes = reader.take(static_cast<std::size_t>(size / 2));
        const unsigned long long content =
            next.compressed ? ZSTD_getFrameContentSize(next.bytes.data(), next.bytes.size()) : next.bytes.size();
        if (content == 0 || content > most - total) {  // also what zstd says where it finds no size
            return corrupt("column " + std::to_string(next.column) +
                           " would unpack to nothing, to an unknown size or to more than " + std::to_string(most - total) +
                           " bytes");
        }
        next.size = static_cast<std::size_t>(content);
        total += next.size;
        stored.push_back(next);
    }
    columns_ = {};
    short_ = false;
    unpacked_.resize(total + sizeof(std::uint64_t));
    bits_.fill({std::as_bytes(std::span(unpacked_)).data() + total, 0, 0});
    std::uint8_t* to = unpacked_.data();
    for (const Stored& column : stored) {
        if (column.compressed) {
            if (ZSTD_decompressDCtx(zstd_.get(), to, column.size, column.bytes.data(), column.bytes.size()) != column.size)
                return corrupt("column " + std::to_string(column.column) + " is no whole zstd frame");
        } else {
            std::transform(column.bytes.begin(), column.bytes.end(), to,
                           [](std::byte byte) { return static_cast<std::uint8_t>(byte); });
        }
        if (column.column < column::kCount) {
            columns_[column.column] = {to, to + column.size};
        } else {
            bits_[column.column - column::kBits] = {std::as_bytes(std::span(to, column.size)).data(), 0, 8 * column.size};
        }
        to += column.size;
    }
    return Done{};
}

bool ColumnReader::all_read() const {
    const auto only_fills_up = [](const BitCursor& at) {
        return at.next == at.end || (at.end - at.next < 8 && static_cast<unsigned>(at.bytes[at.end / 8 - 1]) >> at.next % 8 == 0);
    };
    return std::all_of(bits_.begin(), bits_.end(), only_fills_up) &&
           std::all_of(columns_.begin(), columns_.end(), [](const Cursor& at) { return at.next == at.end; });
}

}  // namespace vsplit

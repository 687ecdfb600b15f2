#include "mrr/columns.h"

#include <algorithm>
#include <cassert>

namespace vsplit {
namespace {

// There is little to find in columns but how often each symbol comes; higher levels find repetitions by chance and gain nothing.
constexpr int kZstdLevel = 1;

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
    [[nodiscard]] bool varint(std::size_t& value) {
        value = 0;
        for (unsigned shift = 0; shift < 35 && !left_.empty(); shift += 7) {
            const auto byte = static_cast<std::uint8_t>(left_.front());
            left_ = left_.subspan(1);
            value |= std::size_t{byte & 0x7FU} << shift;
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

void ColumnWriter::bits(std::uint32_t value, unsigned width) {
    pending_ |= std::uint64_t{value} << pending_bits_;
    pending_bits_ += width;
    for (; pending_bits_ >= 8; pending_bits_ -= 8, pending_ >>= 8U) packed_bits_.push_back(static_cast<char>(pending_ & 0xFFU));
}

void ColumnWriter::number(unsigned column, std::uint32_t value) {
    const Token token = Token::of(value);
    byte(column, token.symbol);
    bits(token.rest, token.bits);
}

void ColumnWriter::clear() {
    for (std::string& column : columns_) column.clear();
    packed_bits_.clear();
    pending_ = 0;
    pending_bits_ = 0;
}

void ColumnWriter::pack(std::string& payload) {
    if (pending_bits_ > 0) bits(0, 8 - pending_bits_);
    std::string compressed;
    const auto put = [&payload](unsigned number, bool is_compressed, const std::string& bytes) {
        payload.push_back(static_cast<char>(number));
        append_varint(payload, bytes.size() * 2 + (is_compressed ? 1 : 0));
        payload += bytes;
    };
    for (unsigned c = 0; c < column::kCount; ++c) {
        if (columns_[c].empty()) continue;
        compressed.resize(ZSTD_compressBound(columns_[c].size()));
        const std::size_t size = ZSTD_compressCCtx(zstd_.get(), compressed.data(), compressed.size(), columns_[c].data(),
                                                   columns_[c].size(), kZstdLevel);
        const bool shorter = ZSTD_isError(size) == 0U && size < columns_[c].size();
        if (shorter) compressed.resize(size);
        put(c, shorter, shorter ? compressed : columns_[c]);
    }
    if (!packed_bits_.empty()) put(column::kBits, false, packed_bits_);
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
        std::size_t size = 0;
        if (!reader.varint(size) || size / 2 > reader.left()) return corrupt("a column does not end where its block does");
        if (next.column > column::kBits || (!stored.empty() && next.column <= stored.back().column))
            return corrupt("column " + std::to_string(next.column) + " where a higher one up to 144 is due");
        next.compressed = size % 2 != 0;
        next.bytes = reader.take(size / 2);
        const unsigned long long content =
            next.compressed ? ZSTD_getFrameContentSize(next.bytes.data(), next.bytes.size()) : next.bytes.size();
        if (content == 0 || content > most - total) {  // also what zstd says where it finds no size
            return corrupt("column " + std::to_string(next.column) + " would unpack to nothing, to an unknown size or to more than " +
                           std::to_string(most - total) + " bytes");
        }
        next.size = static_cast<std::size_t>(content);
        total += next.size;
        stored.push_back(next);
    }
    columns_ = {};
    pending_ = 0;
    pending_bits_ = 0;
    short_ = false;
    unpacked_.resize(total);
    std::uint8_t* to = unpacked_.data();
    for (const Stored& column : stored) {
        if (column.compressed) {
            if (ZSTD_decompressDCtx(zstd_.get(), to, column.size, column.bytes.data(), column.bytes.size()) != column.size)
                return corrupt("column " + std::to_string(column.column) + " is no whole zstd frame");
        } else {
            std::transform(column.bytes.begin(), column.bytes.end(), to, [](std::byte byte) { return static_cast<std::uint8_t>(byte); });
        }
        columns_[column.column] = {to, to + column.size};
        to += column.size;
    }
    return Done{};
}

bool ColumnReader::all_read() const {
    return pending_ == 0 && pending_bits_ < 8 &&
           std::all_of(columns_.begin(), columns_.end(), [](const Cursor& at) { return at.next == at.end; });
}

}  // namespace vsplit

#include "vsplit/mrr/record_block.h"

#include <algorithm>
#include <cassert>
#include <limits>
#include <utility>

#include "base/byte_order.h"
#include "mrr/block_checks.h"

namespace vsplit {
namespace {

constexpr std::size_t kIndexBytes = sizeof(std::uint32_t);
constexpr std::size_t kPointBytes = 3 * sizeof(double);

/// How many records of each kind a block has, and where that puts the columns of kFloat64. Doubles begin at multiples of 8.
struct Columns {
    std::uint64_t splits = 0, flips = 0, moves = 0;

    void add(RecordKind kind) {
        splits += kind == RecordKind::kSplit ? 1 : 0;
        flips += kind == RecordKind::kFlip ? 1 : 0;
        moves += kind == RecordKind::kMove ? 1 : 0;
    }
    [[nodiscard]] std::uint64_t count() const { return splits + flips + moves; }
    static std::uint64_t padded(std::uint64_t count) { return (count + 7) / 8 * 8; }

    [[nodiscard]] std::uint64_t anchor() const { return padded(count()); }
    [[nodiscard]] std::uint64_t steps() const { return anchor() + splits * kIndexBytes; }
    [[nodiscard]] std::uint64_t kept() const { return steps() + splits * kIndexBytes; }
    [[nodiscard]] std::uint64_t added() const { return kept() + splits * kPointBytes; }
    [[nodiscard]] std::uint64_t position() const { return added() + splits * kPointBytes; }
    [[nodiscard]] std::uint64_t half_edge() const { return position() + moves * kPointBytes; }
    [[nodiscard]] std::uint64_t vertex() const { return half_edge() + flips * kIndexBytes; }
    [[nodiscard]] std::uint64_t bytes() const { return vertex() + moves * kIndexBytes; }
};

std::span<const std::byte> bytes_of(const std::string& payload) { return std::as_bytes(std::span(payload)); }

char* store_point(char* to, const Vec3& point) {
    for (int axis = 0; axis < 3; ++axis) to = store(to, point[axis]);
    return to;
}

Vec3 load_point(const std::byte* from) {
    return {load<double>(from), load<double>(from + sizeof(double)), load<double>(from + 2 * sizeof(double))};
}

}  // namespace

Error corrupt_block(const RecordBlock& block, const std::string& what) {
    return {Cause::kCorrupt, "record block from record " + std::to_string(block.first) + " on: " + what, ""};
}

Status check_block(const RecordBlock& block) {
    if (block.payload.size() > kMaxBlockBytes) {
        return corrupt_block(block, std::to_string(block.payload.size()) + " bytes are more than the " +
                                        std::to_string(kMaxBlockBytes) + " a block may have");
    }
    if (block.count > std::numeric_limits<std::uint32_t>::max() - block.first) {
        return corrupt_block(block, "record numbers go beyond 32 bits");
    }
    if (crc32c(bytes_of(block.payload)) != block.crc32c) {
        return corrupt_block(block, "the CRC-32C of the payload is " + std::to_string(crc32c(bytes_of(block.payload))) +
                                        ", not " + std::to_string(block.crc32c) + " as the block says");
    }
    return Done{};
}

namespace {

/// What holds for kFloat64 alone, before anything is read.
Status check_plain(const RecordBlock& block) {
    if (block.encoding != RecordEncoding::kFloat64) {
        return corrupt_block(block, "encoding " + std::to_string(static_cast<std::uint32_t>(block.encoding)) +
                                        " cannot be decoded without a mesh; 1 (float64) can");
    }
    if (Columns::padded(block.count) > block.payload.size()) {
        return corrupt_block(block, std::to_string(block.count) + " records take at least " +
                                        std::to_string(Columns::padded(block.count)) + " bytes, and there are " +
                                        std::to_string(block.payload.size()));
    }
    return check_block(block);
}

/// Counts the kinds of a block, whose columns follow from that. \pre check_plain(block).
Expected<Columns> read_kinds(const RecordBlock& block) {
    Columns columns;
    for (std::size_t n = 0; n < Columns::padded(block.count); ++n) {
        const auto kind = static_cast<std::uint8_t>(block.payload[n]);
        if (n >= block.count && kind != 0) return corrupt_block(block, "the bytes that fill up the kinds are not 0");
        if (n >= block.count) continue;
        if (kind > static_cast<std::uint8_t>(RecordKind::kMove)) {
            return corrupt_block(block, "record " + std::to_string(block.first + n) + " is of kind " + std::to_string(kind) +
                                            "; known are 0 (split), 1 (flip) and 2 (move)");
        }
        columns.add(RecordKind{kind});
    }
    if (columns.bytes() == block.payload.size()) return columns;
    return corrupt_block(block, std::to_string(columns.splits) + " splits, " + std::to_string(columns.flips) + " flips and " +
                                    std::to_string(columns.moves) + " moves take " + std::to_string(columns.bytes()) +
                                    " bytes, not " + std::to_string(block.payload.size()));
}

}  // namespace

std::size_t records_that_fit(const RecordSpan& records, RecordEncoding encoding) {
    assert(encoding == RecordEncoding::kFloat64);
    static_cast<void>(encoding);
    Columns columns;
    for (const RecordKind kind : records.kinds) {
        columns.add(kind);
        if (columns.bytes() > kMaxBlockBytes) return columns.count() - 1;
    }
    return records.size();
}

RecordBlock encode_block(const RecordSpan& records, std::uint32_t first, RecordEncoding encoding, std::string memory) {
    assert(records.consistent());
    assert(records_that_fit(records, encoding) == records.size());
    const Columns columns{records.splits.size(), records.flips.size(), records.moves.size()};
    RecordBlock block{first, static_cast<std::uint32_t>(records.size()), encoding, std::move(memory), 0};
    block.payload.resize(columns.bytes());
    char* const payload = block.payload.data();
    for (std::size_t n = 0; n < records.size(); ++n) payload[n] = static_cast<char>(records.kinds[n]);
    std::fill(payload + records.size(), payload + columns.anchor(), '\0');
    for (std::size_t s = 0; s < records.splits.size(); ++s) {
        const VertexSplit& split = records.splits[s];
        store(payload + columns.anchor() + s * kIndexBytes, split.anchor);
        store(payload + columns.steps() + s * kIndexBytes, split.steps);
        store_point(payload + columns.kept() + s * kPointBytes, split.kept);
        store_point(payload + columns.added() + s * kPointBytes, split.added);
    }
    for (std::size_t f = 0; f < records.flips.size(); ++f) {
        store(payload + columns.half_edge() + f * kIndexBytes, records.flips[f].half_edge);
    }
    for (std::size_t m = 0; m < records.moves.size(); ++m) {
        store_point(payload + columns.position() + m * kPointBytes, records.moves[m].position);
        store(payload + columns.vertex() + m * kIndexBytes, records.moves[m].vertex);
    }
    block.crc32c = crc32c(bytes_of(block.payload));
    return block;
}

Expected<RecordList> decode_block(const RecordBlock& block) {
    if (const Status status = check_plain(block); !status) return status.error();
    const Expected<Columns> columns = read_kinds(block);
    if (!columns) return columns.error();
    const std::byte* const payload = bytes_of(block.payload).data();
    RecordList records;
    records.reserve(columns->splits, columns->flips, columns->moves);
    Columns read;
    for (std::size_t n = 0; n < block.count; ++n) {
        const RecordKind kind{static_cast<std::uint8_t>(block.payload[n])};
        if (kind == RecordKind::kSplit) {
            records.push_back(VertexSplit{load<std::uint32_t>(payload + columns->anchor() + read.splits * kIndexBytes),
                                          load<std::uint32_t>(payload + columns->steps() + read.splits * kIndexBytes),
                                          load_point(payload + columns->kept() + read.splits * kPointBytes),
                                          load_point(payload + columns->added() + read.splits * kPointBytes)});
        } else if (kind == RecordKind::kFlip) {
            records.push_back(EdgeFlip{load<std::uint32_t>(payload + columns->half_edge() + read.flips * kIndexBytes)});
        } else {
            records.push_back(VertexMove{load<std::uint32_t>(payload + columns->vertex() + read.moves * kIndexBytes),
                                         load_point(payload + columns->position() + read.moves * kPointBytes)});
        }
        read.add(kind);
    }
    return records;
}

}  // namespace vsplit

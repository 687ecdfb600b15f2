#include "vsplit/mrr/record_block.h"

#include <boost/crc.hpp>
#include <cassert>
#include <limits>

#include "base/byte_order.h"

namespace vsplit {
namespace {

// The columns of kFloat64: anchors, steps, kept points, added points.
constexpr std::size_t kIndexBytes = sizeof(std::uint32_t);
constexpr std::size_t kPointBytes = 3 * sizeof(double);
constexpr std::size_t kSplitBytes = 2 * kIndexBytes + 2 * kPointBytes;

std::span<const std::byte> bytes_of(const std::string& payload) { return std::as_bytes(std::span(payload)); }

char* store_point(char* to, const Vec3& point) {
    for (int axis = 0; axis < 3; ++axis) to = store(to, point[axis]);
    return to;
}

Vec3 load_point(const std::byte* from) {
    return {load<double>(from), load<double>(from + sizeof(double)), load<double>(from + 2 * sizeof(double))};
}

Error corrupt(const RecordBlock& block, const std::string& what) {
    return {Cause::kCorrupt, "record block from split " + std::to_string(block.first) + " on: " + what, ""};
}

Status check_block(const RecordBlock& block) {
    if (block.encoding != RecordEncoding::kFloat64) {
        return corrupt(block,
                       "encoding " + std::to_string(static_cast<std::uint32_t>(block.encoding)) + " is unknown; 1 (float64) is");
    }
    if (block.payload.size() > kMaxBlockBytes) {
        return corrupt(block, std::to_string(block.payload.size()) + " bytes are more than the " +
                                  std::to_string(kMaxBlockBytes) + " a block may have");
    }
    if (block.payload.size() != block.count * kSplitBytes) {
        return corrupt(block, std::to_string(block.count) + " splits take " + std::to_string(block.count * kSplitBytes) +
                                  " bytes, not " + std::to_string(block.payload.size()));
    }
    if (block.count > std::numeric_limits<std::uint32_t>::max() - block.first) {
        return corrupt(block, "split numbers go beyond 32 bits");
    }
    if (crc32c(bytes_of(block.payload)) != block.crc32c) {
        return corrupt(block, "the CRC-32C of the payload is " + std::to_string(crc32c(bytes_of(block.payload))) + ", not " +
                                  std::to_string(block.crc32c) + " as the block says");
    }
    return Done{};
}

}  // namespace

std::uint32_t splits_per_block(RecordEncoding encoding) {
    assert(encoding == RecordEncoding::kFloat64);
    static_cast<void>(encoding);
    return kMaxBlockBytes / kSplitBytes;
}

RecordBlock encode_block(std::span<const VertexSplit> splits, std::uint32_t first, RecordEncoding encoding) {
    assert(splits.size() <= splits_per_block(encoding));
    RecordBlock block{first, static_cast<std::uint32_t>(splits.size()), encoding, std::string(splits.size() * kSplitBytes, '\0'),
                      0};
    char* anchor = block.payload.data();
    char* steps = anchor + splits.size() * kIndexBytes;
    char* kept = steps + splits.size() * kIndexBytes;
    char* added = kept + splits.size() * kPointBytes;
    for (const VertexSplit& split : splits) {
        anchor = store(anchor, split.anchor);
        steps = store(steps, split.steps);
        kept = store_point(kept, split.kept);
        added = store_point(added, split.added);
    }
    block.crc32c = crc32c(bytes_of(block.payload));
    return block;
}

Expected<std::vector<VertexSplit>> decode_block(const RecordBlock& block) {
    if (const Status status = check_block(block); !status) return status.error();
    const std::byte* const anchor = bytes_of(block.payload).data();
    const std::byte* const steps = anchor + block.count * kIndexBytes;
    const std::byte* const kept = steps + block.count * kIndexBytes;
    const std::byte* const added = kept + block.count * kPointBytes;
    std::vector<VertexSplit> splits(block.count);
    for (std::size_t i = 0; i < splits.size(); ++i) {
        splits[i] = {load<std::uint32_t>(anchor + i * kIndexBytes), load<std::uint32_t>(steps + i * kIndexBytes),
                     load_point(kept + i * kPointBytes), load_point(added + i * kPointBytes)};
    }
    return splits;
}

std::uint32_t crc32c(std::span<const std::byte> bytes) {
    boost::crc_optimal<32, 0x1EDC6F41, 0xFFFFFFFF, 0xFFFFFFFF, true, true> crc;
    crc.process_bytes(bytes.data(), bytes.size());
    return crc.checksum();
}

}  // namespace vsplit

#include <algorithm>
#include <cassert>
#include <limits>

#include "base/byte_order.h"
#include "mrr/mrr_layout.h"
#include "mrr/region_section.h"
#include "vsplit/mrr/mrr_file.h"
#include "vsplit/mrr/record_block.h"

namespace vsplit {
namespace {

std::uint32_t crc_between(const char* from, const char* to) { return crc32c(std::as_bytes(std::span(from, to))); }

char* store_base(char* to, const StoredMrr& stored) {
    for (const Vec3& position : stored.mrr.base.positions) {
        for (int axis = 0; axis < 3; ++axis) to = store(to, position[axis]);
    }
    for (const Triangle& face : stored.mrr.base.faces) {
        for (const std::uint32_t vertex : face) to = store(to, vertex);
    }
    return std::copy(stored.description.begin(), stored.description.end(), to);
}

void store_header(char* file, const StoredMrr& stored, std::uint32_t base_crc) {
    char* to = std::copy(kMrrMagic.begin(), kMrrMagic.end(), file);
    for (const std::uint32_t field :
         {kMrrVersion, stored.mrr.base.vertex_count(), stored.mrr.base.face_count(), stored.mrr.ghosts,
          static_cast<std::uint32_t>(stored.mrr.levels()), static_cast<std::uint32_t>(stored.mrr.records.size()), stored.faces,
          static_cast<std::uint32_t>(stored.description.size()), base_crc}) {
        to = store(to, field);
    }
    assert(to == file + kMrrHeaderCrcAt);
    store(to, crc_between(file, to));
}

char* store_block(char* to, const RecordBlock& block) {
    for (const std::uint32_t field : {block.first, block.count, static_cast<std::uint32_t>(block.encoding),
                                      static_cast<std::uint32_t>(block.payload.size()), block.crc32c}) {
        to = store(to, field);
    }
    return std::copy(block.payload.begin(), block.payload.end(), to);
}

/// What the blocks of all records take at most: no record takes more than a split, and all blocks but the last have no room for
/// another.
std::size_t most_block_bytes(const RecordList& records) {
    constexpr std::size_t kSplit = record_bytes(RecordKind::kSplit), kFill = 7;
    const std::size_t payload = records.splits().size() * kSplit + records.flips().size() * record_bytes(RecordKind::kFlip) +
                                records.moves().size() * record_bytes(RecordKind::kMove);
    const std::size_t blocks = payload / (kMaxBlockBytes - kSplit - kFill) + 1;
    return payload + blocks * (kMrrBlockHeaderBytes + kFill);
}

}  // namespace

std::string encode_mrr(const StoredMrr& stored) {
    [[maybe_unused]] constexpr std::size_t kLargest = std::numeric_limits<std::uint32_t>::max();
    assert(stored.description.size() <= kLargest && stored.mrr.records.size() <= kLargest);
    const std::size_t base_bytes = stored.mrr.base.positions.size() * kMrrVertexBytes +
                                   stored.mrr.base.faces.size() * kMrrFaceBytes + stored.description.size();
    std::string bytes(kMrrHeaderBytes + base_bytes, '\0');
    const char* const base_end = store_base(bytes.data() + kMrrHeaderBytes, stored);
    store_header(bytes.data(), stored, crc_between(bytes.data() + kMrrHeaderBytes, base_end));

    const RecordList& records = stored.mrr.records;
    bytes.reserve(bytes.size() + most_block_bytes(records));
    for (std::size_t first = 0; first < records.size();) {
        const std::size_t count = records_that_fit(records.slice(first, records.size() - first), RecordEncoding::kFloat64);
        const RecordBlock block =
            encode_block(records.slice(first, count), static_cast<std::uint32_t>(first), RecordEncoding::kFloat64);
        const std::size_t at = bytes.size();
        bytes.resize(at + kMrrBlockHeaderBytes + block.payload.size());
        store_block(bytes.data() + at, block);
        first += count;
    }
    return bytes + encode_regions(stored.mrr);
}

}  // namespace vsplit

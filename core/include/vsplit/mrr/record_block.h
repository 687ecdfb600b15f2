#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "vsplit/base/expected.h"
#include "vsplit/mrr/position_grid.h"
#include "vsplit/mrr/records.h"

namespace vsplit {

/// Bytes that a record adds to a block of the encoding kFloat64, beside at most 7 that fill up a block.
[[nodiscard]] constexpr std::size_t record_bytes(RecordKind kind) {
    return kind == RecordKind::kSplit ? 57 : kind == RecordKind::kMove ? 29 : 5;
}

/// A run of records as it travels and as it is stored.
struct RecordBlock {
    std::uint32_t first = 0;  ///< number of the first record
    std::uint32_t count = 0;
    RecordEncoding encoding = RecordEncoding::kFloat64;
    std::string payload;
    std::uint32_t crc32c = 0;  ///< CRC-32C (Castagnoli) of the payload
};

/// No block's payload is larger.
inline constexpr std::size_t kMaxBlockBytes = std::size_t{256} * 1024;

/// How many of `records`, from the first on, fit one block of the encoding kFloat64; not 0 unless there are none. O(the count).
/// \pre encoding is kFloat64, the only one that needs no mesh: for any other see RecordCodec.
[[nodiscard]] std::size_t records_that_fit(const RecordSpan& records, RecordEncoding encoding);

/// \pre records.consistent(), and records_that_fit(records, encoding) is records.size(). O(records). `memory` may be the payload
/// of a block that is over: its memory is used again.
[[nodiscard]] RecordBlock encode_block(const RecordSpan& records, std::uint32_t first, RecordEncoding encoding,
                                       std::string memory = {});

/// Of the encoding kFloat64. \return CORRUPT naming the block by its first record, when the checksum, the size, a kind or the
/// encoding does not fit. Whether the records fit a mesh is for ProgressiveMesh::refine to say. O(records).
[[nodiscard]] Expected<RecordList> decode_block(const RecordBlock& block);

/// CRC-32C of bytes, or of those whose checksum was `before` with these behind them.
[[nodiscard]] std::uint32_t crc32c(std::span<const std::byte> bytes, std::uint32_t before = 0);

}  // namespace vsplit

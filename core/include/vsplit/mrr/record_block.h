#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "vsplit/base/expected.h"
#include "vsplit/mrr/multires_mesh.h"

namespace vsplit {

/// How the splits of a block are laid out as bytes (docs/format.md).
enum class RecordEncoding : std::uint32_t {
    kFloat64 =
        1,  ///< bit-exact: columns of anchor (u32), steps (u32), kept (3 f64), added (3 f64), little-endian; 56 bytes a split
};

/// A run of splits as it travels and as it is stored.
struct RecordBlock {
    std::uint32_t first = 0;  ///< number of the first split
    std::uint32_t count = 0;
    RecordEncoding encoding = RecordEncoding::kFloat64;
    std::string payload;
    std::uint32_t crc32c = 0;  ///< CRC-32C (Castagnoli) of the payload
};

/// No block's payload is larger.
inline constexpr std::size_t kMaxBlockBytes = std::size_t{256} * 1024;

/// Splits that fit one block of this encoding.
[[nodiscard]] std::uint32_t splits_per_block(RecordEncoding encoding);

/// \pre splits.size() <= splits_per_block(encoding). O(splits).
[[nodiscard]] RecordBlock encode_block(std::span<const VertexSplit> splits, std::uint32_t first, RecordEncoding encoding);

/// \return CORRUPT naming the block by its first split, when the checksum, the size or the encoding does not fit. Whether the
/// splits fit a mesh is for ProgressiveMesh::refine to say. O(splits).
[[nodiscard]] Expected<std::vector<VertexSplit>> decode_block(const RecordBlock& block);

/// CRC-32C of bytes.
[[nodiscard]] std::uint32_t crc32c(std::span<const std::byte> bytes);

}  // namespace vsplit

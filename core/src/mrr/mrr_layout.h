#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "vsplit/mesh/length_unit.h"
#include "vsplit/mrr/mrr_file.h"
#include "vsplit/mrr/position_grid.h"
#include "vsplit/mrr/record_block.h"

namespace vsplit {

/// The layout of a `.vsplit` file; docs/format.md describes it for those who read it without this library.

/// As PNG's mark: a byte that is no text, the name, and line ends that a transfer as text would change.
inline constexpr std::string_view kMrrMagic = "\x89VSP\r\n\x1a\n";

/// Files are written in this version; this one and all before it are read.
inline constexpr std::uint32_t kMrrVersion = 3;

/// Offsets that all versions have in common; counts are little-endian u32.
inline constexpr std::size_t kMrrVersionAt = 8;
inline constexpr std::size_t kMrrVerticesAt = 12;
inline constexpr std::size_t kMrrFacesAt = 16;
inline constexpr std::size_t kMrrGhostsAt = 20;
inline constexpr std::size_t kMrrSplitsAt = 24;
inline constexpr std::size_t kMrrRecordsAt = 28;
inline constexpr std::size_t kMrrShownAt = 32;
inline constexpr std::size_t kMrrDescriptionAt = 36;

/// Version 1: all records in FLOAT64, a header before each block.
inline constexpr std::size_t kMrr1BaseCrcAt = 40;
inline constexpr std::size_t kMrr1HeaderCrcAt = 44;
inline constexpr std::size_t kMrr1HeaderBytes = 48;
/// Before each block's payload: first, count, encoding, payload bytes, CRC-32C of the payload.
inline constexpr std::size_t kMrr1BlockHeaderBytes = 20;

/// From version 2 on: any encoding, an index of all blocks in front of them. In version 3 blocks may be of layout 1.
inline constexpr std::size_t kMrr2BlocksAt = 40;
inline constexpr std::size_t kMrr2EncodingAt = 44;
inline constexpr std::size_t kMrr2BitsAt = 48;
inline constexpr std::size_t kMrr2UnitAt = 52;
inline constexpr std::size_t kMrr2BaseBytesAt = 56;       // u64
inline constexpr std::size_t kMrr2OriginAt = 64;          // 3 f64
inline constexpr std::size_t kMrr2StepAt = 88;            // f64
inline constexpr std::size_t kMrr2MaxErrorAt = 96;        // f64
inline constexpr std::size_t kMrr2BaseDeviationAt = 104;  // f64
inline constexpr std::size_t kMrr2BoxAt = 112;            // 6 f64
inline constexpr std::size_t kMrr2SourceAt = 160;         // 32 bytes
inline constexpr std::size_t kMrr2FileBytesAt = 192;      // u64
inline constexpr std::size_t kMrr2BodyCrcAt = 200;
inline constexpr std::size_t kMrr2HeaderCrcAt = 204;
inline constexpr std::size_t kMrr2HeaderBytes = 208;
/// Of a block: first, count, splits, faces, deviation (f64), offset (u64), payload bytes, CRC-32C of the payload.
inline constexpr std::size_t kMrr2IndexBytes = 40;

inline constexpr std::size_t kMrrVertexBytes = 24;
inline constexpr std::size_t kMrrFaceBytes = 12;

/// A deviation that nobody measured, as a file says it.
inline constexpr double kNotMeasured = std::numeric_limits<double>::quiet_NaN();

/// The number that stands for a unit in a file; 0 for none.
[[nodiscard]] std::uint32_t number_of(std::optional<LengthUnit> unit);
/// The way back; false where there is no such number.
[[nodiscard]] bool unit_by_number(std::uint32_t number, std::optional<LengthUnit>& unit);

/// Where a block lies and what it must come to.
struct MrrBlockPlace {
    std::uint32_t first = 0, count = 0;
    RecordEncoding encoding = RecordEncoding::kFloat64;
    std::size_t at = 0;  ///< byte that errors name: its header's (version 1) or its payload's
    std::span<const std::byte> payload{};
    std::uint32_t crc32c = 0;
    std::optional<std::uint32_t> splits{}, faces{};  ///< after it; version 1 does not say
    double deviation = kNotMeasured;
};

/// A file taken apart, without a look at mesh and records.
struct MrrLayout {
    std::uint32_t vertices = 0, faces = 0, ghosts = 0, splits = 0, records = 0, shown = 0;
    std::size_t base_at = 0;
    bool packed = false;  ///< the base mesh, as pack_base does
    std::span<const std::byte> base, description, regions;
    std::size_t regions_at = 0;
    std::vector<MrrBlockPlace> blocks;
    PositionGrid grid;
    std::optional<LengthUnit> unit;
    double max_error = 0;
    double base_deviation = kNotMeasured;
    std::optional<BoundingBox> box;  ///< version 1 has none
    std::optional<SourceHash> source;
};

/// Checks mark, version, all sizes against the bytes that are there, and all checksums but those of the blocks' payloads.
/// \return as decode_mrr. O(bytes of base mesh and description, blocks). The layout refers to `bytes`.
[[nodiscard]] Expected<MrrLayout> read_mrr_layout(std::span<const std::byte> bytes);

/// An error that names the byte.
[[nodiscard]] Error error_at(Cause cause, std::size_t byte, const std::string& what);

}  // namespace vsplit

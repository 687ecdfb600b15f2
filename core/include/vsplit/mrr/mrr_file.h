#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "vsplit/base/expected.h"
#include "vsplit/mesh/length_unit.h"
#include "vsplit/mrr/multires_mesh.h"
#include "vsplit/mrr/position_grid.h"

namespace vsplit {

/// SHA-256 of the file that an MRR was made from.
using SourceHash = std::array<std::uint8_t, 32>;

/// How far a level and the source are apart at most, either way, as somebody measured it.
struct LevelDeviation {
    std::uint32_t level = 0;
    double most = 0;  ///< length >= 0, model units

    friend bool operator==(const LevelDeviation&, const LevelDeviation&) = default;
};

/// A `.vsplit` file (docs/format.md): an MRR, the resolution its maker chose, and what is known of how it was made.
struct StoredMrr {
    MultiresMesh mrr;         ///< all positions on `grid`
    std::uint32_t faces = 0;  ///< the resolution to show first
    std::string description;  ///< proto3 JSON of a vsplit.v1.Representation when written by `vsplit`; opaque to core
    PositionGrid grid{};      ///< and with it the encoding of the file
    double max_error = 0;     ///< what rounding moved any coordinate by at most, model units
    std::optional<LengthUnit> unit{};
    std::optional<SourceHash> source{};
    std::vector<LevelDeviation> deviations{};  ///< by level, ascending, no level twice

    friend bool operator==(const StoredMrr&, const StoredMrr&) = default;
};

/// `stored` in another encoding: its positions rounded, its error and deviations grown by what rounding adds. O(records).
/// \return as check_encoding.
[[nodiscard]] Expected<StoredMrr> in_encoding(StoredMrr stored, const EncodingChoice& choice);

/// The bytes of a `.vsplit` file; the same input gives the same bytes. A block ends at the level to show and at each whose
/// deviation is known. O(records). \pre in encodings other than kFloat64: `mrr` was made by this library (asserts otherwise).
[[nodiscard]] std::string encode_mrr(const StoredMrr& stored);

/// Reads files of every version there was. \return UNKNOWN_FORMAT, UNSUPPORTED (a newer version), TRUNCATED_INPUT or CORRUPT
/// with the byte offset. Sizes in headers are checked against the bytes that are there before memory is taken. Every record is
/// tried once. O(records * ring).
[[nodiscard]] Expected<StoredMrr> decode_mrr(std::span<const std::byte> bytes);

/// Writes beside `path` and renames. FILE_ACCESS on failure.
[[nodiscard]] Status save_mrr(const StoredMrr& stored, const std::filesystem::path& path);

/// NOT_FOUND, FILE_ACCESS, or what decode_mrr returns.
[[nodiscard]] Expected<StoredMrr> load_mrr(const std::filesystem::path& path);

}  // namespace vsplit

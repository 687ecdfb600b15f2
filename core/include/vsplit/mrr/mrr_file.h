#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

#include "vsplit/base/expected.h"
#include "vsplit/mrr/multires_mesh.h"

namespace vsplit {

/// A `.vsplit` file (docs/format.md): an MRR, the resolution its maker chose, and a text that describes how it was made.
struct StoredMrr {
    MultiresMesh mrr;
    std::uint32_t faces = 0;  ///< the resolution to show first
    std::string description;  ///< proto3 JSON of a vsplit.v1.Representation when written by `vsplit`; opaque to core
};

/// The bytes of a `.vsplit` file; the same input gives the same bytes. O(records).
[[nodiscard]] std::string encode_mrr(const StoredMrr& stored);

/// \return UNKNOWN_FORMAT, UNSUPPORTED (a newer version), TRUNCATED_INPUT or CORRUPT with the byte offset. Sizes in headers are
/// checked against the bytes that are there before memory is taken. Every record is tried once. O(records * ring).
[[nodiscard]] Expected<StoredMrr> decode_mrr(std::span<const std::byte> bytes);

/// Writes beside `path` and renames. FILE_ACCESS on failure.
[[nodiscard]] Status save_mrr(const StoredMrr& stored, const std::filesystem::path& path);

/// NOT_FOUND, FILE_ACCESS, or what decode_mrr returns.
[[nodiscard]] Expected<StoredMrr> load_mrr(const std::filesystem::path& path);

}  // namespace vsplit

#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace vsplit {

/// The layout of a `.vsplit` file; docs/format.md describes it for those who read it without this library.

/// As PNG's mark: a byte that is no text, the name, and line ends that a transfer as text would change.
inline constexpr std::string_view kMrrMagic = "\x89VSP\r\n\x1a\n";

inline constexpr std::uint32_t kMrrVersion = 1;

/// Offsets in the header; every field is a little-endian u32.
inline constexpr std::size_t kMrrVersionAt = 8;
inline constexpr std::size_t kMrrVerticesAt = 12;
inline constexpr std::size_t kMrrFacesAt = 16;
inline constexpr std::size_t kMrrGhostsAt = 20;
inline constexpr std::size_t kMrrSplitsAt = 24;
inline constexpr std::size_t kMrrRecordsAt = 28;
inline constexpr std::size_t kMrrShownAt = 32;
inline constexpr std::size_t kMrrDescriptionAt = 36;
inline constexpr std::size_t kMrrBaseCrcAt = 40;
inline constexpr std::size_t kMrrHeaderCrcAt = 44;
inline constexpr std::size_t kMrrHeaderBytes = 48;

inline constexpr std::size_t kMrrVertexBytes = 24;
inline constexpr std::size_t kMrrFaceBytes = 12;

/// Before each block's payload: first, count, encoding, payload bytes, CRC-32C of the payload.
inline constexpr std::size_t kMrrBlockHeaderBytes = 20;

}  // namespace vsplit

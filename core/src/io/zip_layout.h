#pragma once

#include <cstddef>
#include <cstdint>

/// The layout of zip archives (PKWARE's APPNOTE.TXT 4.3), numbers little-endian: what reader and writer share.
namespace vsplit::zip {

inline constexpr std::uint32_t kLocalHeader = 0x04034B50;
inline constexpr std::uint32_t kTableEntry = 0x02014B50;
inline constexpr std::uint32_t kTableEnd = 0x06054B50;
inline constexpr std::uint32_t kTableEnd64 = 0x06064B50;
inline constexpr std::uint32_t kTableEnd64Locator = 0x07064B50;

inline constexpr std::size_t kLocalHeaderBytes = 30;
inline constexpr std::size_t kTableEntryBytes = 46;
inline constexpr std::size_t kTableEndBytes = 22;
inline constexpr std::size_t kTableEnd64Bytes = 56;
inline constexpr std::size_t kLocatorBytes = 20;

inline constexpr std::uint16_t kStored = 0;
inline constexpr std::uint16_t kDeflated = 8;

/// A number that stands in the extra field instead, where 32 bits do not hold it.
inline constexpr std::uint32_t kElsewhere = 0xFFFFFFFF;
inline constexpr std::uint16_t kExtra64 = 1;

}  // namespace vsplit::zip

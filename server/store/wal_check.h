#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace vsplit::store {

/// Transactions of a write-ahead log of SQLite that its recovery will pass over in silence, at least; 0 for a log that is sound.
///
/// SQLite reads a log (https://sqlite.org/fileformat2.html#walformat) up to the first frame whose checksum fails, as a crash
/// while a transaction is written leaves one at the end. Where transactions end behind that frame, they had been synchronised: it
/// is damage. (A loss of power that wrote the end of the last transaction and not its beginning looks the same.) Frames from
/// before the log was begun anew have other salts and count for nothing. A log whose header is damaged is passed over whole.
/// Damage of the last transaction cannot be told from a crash. O(bytes).
[[nodiscard]] std::uint64_t transactions_lost(std::span<const std::byte> log);

}  // namespace vsplit::store

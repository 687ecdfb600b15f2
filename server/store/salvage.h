#pragma once

#include <filesystem>

#include "store/session_index.h"

namespace vsplit::store {

/// What is sound of a damaged index, whose file stays as it is: sessions and representations that can be read and whose digests
/// hold, methods that run in these sessions, and the clock, if it is as it was written. Rows are looked for from both ends of a
/// table, past what is damaged between, and with the schema of a new index too, where the index's own is what is damaged.
/// `copy` is a place for that, left empty. Nothing where the file is no database. O(file).
[[nodiscard]] IndexContents salvage(const std::filesystem::path& index, const std::filesystem::path& copy);

}  // namespace vsplit::store

#pragma once

#include <cstdint>
#include <filesystem>

#include "vsplit/base/expected.h"

namespace vsplit::store {

/// Names in a data directory.
inline constexpr const char* kIndexName = "sessions.db";
inline constexpr const char* kBlobsName = "blobs";

/// What becomes of the files of the index: they are written to again, replaced by others, or gone from their place.
enum class Original { kIsUsed, kIsReplaced, kGoes };

/// Keeps the index of a data directory as it is, and its blobs, in a new `directory`/damaged-N, or in the last one where these
/// very files are there already. Blobs stay in their place too: they are linked, which takes no disk, and so is an index that is
/// replaced. Returns where. \return what `disk_error` returns; then nothing has left its place for
/// good.
[[nodiscard]] Expected<std::filesystem::path> keep_damaged(const std::filesystem::path& directory, Original original);

/// How many damaged-N there are: somebody is to look at them, and to delete them.
[[nodiscard]] std::uint32_t count_damaged(const std::filesystem::path& directory);

}  // namespace vsplit::store

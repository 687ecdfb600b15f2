#pragma once

#include <cstdint>
#include <filesystem>

#include "vsplit/base/expected.h"

namespace vsplit::store {

/// Names in a data directory.
inline constexpr const char* kIndexName = "sessions.db";
inline constexpr const char* kBlobsName = "blobs";

/// Whether the files of the index stay in their place.
enum class Original { kStays, kGoes };

/// Keeps the index of a data directory as it is, and its blobs, in a new `directory`/damaged-N. Blobs stay in their place too:
/// they are linked, which takes no disk. Returns where. \return what `disk_error` returns; then nothing has left its place for
/// good.
[[nodiscard]] Expected<std::filesystem::path> keep_damaged(const std::filesystem::path& directory, Original original);

/// How many damaged-N there are: somebody is to look at them, and to delete them.
[[nodiscard]] std::uint32_t count_damaged(const std::filesystem::path& directory);

}  // namespace vsplit::store

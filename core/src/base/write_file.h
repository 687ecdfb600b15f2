#pragma once

#include <filesystem>
#include <string_view>

#include "vsplit/base/expected.h"

namespace vsplit {

/// Makes `bytes` the content of `path`, so that at every moment, even through a power cut, the file is the old or the new one:
/// writes a file beside it, syncs, renames. A link is followed; a pipe or device is written to as it is.
/// \return FILE_ACCESS or NOT_FOUND (no such directory) with the system's reason; the old file is then unharmed.
[[nodiscard]] Status write_file(const std::filesystem::path& path, std::string_view bytes);

}  // namespace vsplit

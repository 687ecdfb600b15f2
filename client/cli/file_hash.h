#pragma once

#include <string>

#include "vsplit/base/expected.h"
#include "vsplit/mrr/mrr_file.h"

namespace vsplit::cli {

/// SHA-256 of a file's bytes, as sha256sum prints it. \return NOT_FOUND, FILE_ACCESS. O(bytes).
[[nodiscard]] Expected<SourceHash> hash_of_file(const std::string& path);

}  // namespace vsplit::cli

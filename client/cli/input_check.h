#pragma once

#include <string>

#include "cli/arguments.h"
#include "vsplit/base/expected.h"

namespace vsplit::cli {

/// Whether --weld and --repair have a mesh to work on: a .vsplit file, and what a session holds, were welded and repaired when
/// they were read. \return INVALID_OPTION.
[[nodiscard]] Status check_reading(const Arguments& arguments);

/// The error as it is told of a file: where it is about what the file holds, its path comes before the place.
[[nodiscard]] Error in_file(Error error, const std::string& path);

}  // namespace vsplit::cli

#pragma once

#include <string>
#include <vector>

#include "cli/arguments.h"
#include "vsplit/base/expected.h"

namespace vsplit::cli {

/// The numbers of a text file, one a line; empty lines are left out.
/// \return NOT_FOUND or FILE_ACCESS; MALFORMED_INPUT naming the line that is no number; EMPTY_INPUT without any.
[[nodiscard]] Expected<std::vector<double>> read_size_field(const std::string& path);

/// Puts the file that --size-field names, if it does, into the options of the verb. \return what read_size_field returns.
[[nodiscard]] Status read_size_field_into(Arguments& arguments);

}  // namespace vsplit::cli

#pragma once

#include <filesystem>

#include "vsplit/base/expected.h"

namespace vsplit::store {

/// Copies an index, and its log, and gives the copy the first page of a new index: that has the schema and where its tables
/// begin, which is the same in every index, so that one whose first page is lost can be read. What was at `copy` before goes. The
/// copy is to be read only: what it knows of free pages is nothing. \return what `make_index` and `disk_error` return; then
/// nothing is left there.
[[nodiscard]] Status copy_with_new_first_page(const std::filesystem::path& index, const std::filesystem::path& copy);

}  // namespace vsplit::store

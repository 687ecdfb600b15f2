#pragma once

#include <filesystem>
#include <system_error>

#include "store/session_index.h"
#include "vsplit/base/expected.h"

namespace vsplit::store {

/// Makes an index with these contents, whole and synchronised, without a log. \return what SqliteSessionIndex::open and take_over
/// return.
[[nodiscard]] Status make_index(const std::filesystem::path& place, const IndexContents& contents);

/// An index and its log, if they are there.
void remove_index(const std::filesystem::path& index, std::error_code& failed);

/// Makes an index with these contents and puts it in the place of the data directory's, so that at any end of the process either
/// the old one is there or the new one, whole. \return as `make_index`; then the old one stays.
[[nodiscard]] Status replace_index(const std::filesystem::path& directory, const IndexContents& contents);

/// Does what an end of the process left undone of `replace_index`. To be called before an index is opened.
[[nodiscard]] Status finish_replacement(const std::filesystem::path& directory);

}  // namespace vsplit::store

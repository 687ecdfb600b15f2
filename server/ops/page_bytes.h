#pragma once

#include <span>
#include <string_view>

namespace vsplit::ops {

// Files that the build puts into the program.

struct EmbeddedFile {
    std::string_view path;  ///< in its folder, without a slash before it
    std::string_view bytes;
};

/// What Vite made of client/web.
[[nodiscard]] std::span<const EmbeddedFile> built_page();

[[nodiscard]] std::string_view sample_bracket();
[[nodiscard]] std::string_view sample_scan();

}  // namespace vsplit::ops

#pragma once

#include <string_view>

namespace vsplit::ops {

// Files that the build puts into the program.
[[nodiscard]] std::string_view page_html();
[[nodiscard]] std::string_view page_script();
[[nodiscard]] std::string_view page_worker();
[[nodiscard]] std::string_view page_style();
[[nodiscard]] std::string_view page_icon();
[[nodiscard]] std::string_view sample_bracket();
[[nodiscard]] std::string_view sample_scan();

}  // namespace vsplit::ops

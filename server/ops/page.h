#pragma once

#include "rest/pages.h"

namespace vsplit::ops {

/// The files of the page and its samples, by path; none where the page was left out of the build.
[[nodiscard]] rest::Pages page_files();

}  // namespace vsplit::ops

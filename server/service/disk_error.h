#pragma once

#include <cerrno>
#include <string>
#include <string_view>

#include "vsplit/base/expected.h"

namespace vsplit::service {

/// What the operating system said of a call. \return LIMIT_EXCEEDED where the disk is full, else UNAVAILABLE: what is in memory
/// can be read on, and the same request may succeed when somebody has seen to the disk.
[[nodiscard]] Error disk_error(std::string_view what, int number = errno);

}  // namespace vsplit::service

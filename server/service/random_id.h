#pragma once

#include <string>

#include "vsplit/base/expected.h"

namespace vsplit::service {

/// 128 bits from the operating system's generator as 32 hexadecimal digits: nobody guesses another one's session.
/// \return INTERNAL when the operating system has none to give.
[[nodiscard]] Expected<std::string> random_id();

}  // namespace vsplit::service

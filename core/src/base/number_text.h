#pragma once

#include <string>

namespace vsplit {

/// Six significant digits, as messages show a number, e.g. "0.25", "1e-07", "nan".
[[nodiscard]] std::string number_text(double value);

}  // namespace vsplit

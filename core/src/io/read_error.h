#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "base/quoted.h"
#include "vsplit/base/error.h"

namespace vsplit {

/// Where in a file: "line 12" (from 1) or "byte 84" (from 0); "line 1, column 9000" where a column is given.
struct Place {
    std::string_view unit;
    std::size_t number = 0;
    std::size_t column = 0;  ///< from 1; 0: not told
};

[[nodiscard]] inline Place at_line(std::size_t line, std::size_t column = 0) { return {"line", line, column}; }
[[nodiscard]] inline Place at_byte(std::size_t byte) { return {"byte", byte, 0}; }

/// "line 12: what".
[[nodiscard]] Error read_error(Cause cause, Place place, std::string_view what);

/// "found 'x'", or "found the line's end" for an empty word.
[[nodiscard]] std::string found(std::string_view word);

/// A number as a person would write it, e.g. "0.1", "nan".
[[nodiscard]] std::string to_text(double value);

}  // namespace vsplit

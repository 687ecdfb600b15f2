#include "base/number_text.h"

#include <array>
#include <cstdio>

namespace vsplit {

std::string number_text(double value) {
    std::array<char, 32> text{};
    const int length = std::snprintf(text.data(), text.size(), "%g", value);
    return {text.data(), static_cast<std::size_t>(length)};
}

}  // namespace vsplit

#include "cli/number_text.h"

#include <array>
#include <cstdio>

namespace vsplit::cli {
namespace {

template <class... Values>
std::string printed(const char* format, Values... values) {
    std::array<char, 400> text{};  // %f of the largest double has 309 digits
    std::snprintf(text.data(), text.size(), format, values...);
    return text.data();
}

}  // namespace

std::string grouped(std::uint64_t number) {
    std::string text = std::to_string(number);
    for (std::size_t i = text.size(); i > 3;) text.insert(i -= 3, 1, ',');
    return text;
}

std::string counted(std::uint64_t number, const std::string& one, const std::string& many) {
    return grouped(number) + " " + (number == 1 ? one : many);
}

std::string figure(double number) { return printed("%.6g", number); }

std::string fixed(double number, int digits) { return printed("%.*f", digits, number); }

std::string right(const std::string& text, std::size_t width) {
    return text.size() < width ? std::string(width - text.size(), ' ') + text : text;
}

std::string left(const std::string& text, std::size_t width) {
    return text.size() < width ? text + std::string(width - text.size(), ' ') : text;
}

}  // namespace vsplit::cli

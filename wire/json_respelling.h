#pragma once

#include <cstddef>
#include <iterator>
#include <string>
#include <string_view>
#include <utility>

namespace vsplit::wire {

/// A JSON text on its way through nlohmann's lexer, which says nowhere how far it is: this does, after each character it takes.
class Place {
public:
    // NOLINTBEGIN(readability-identifier-naming): the standard's names
    using iterator_category = std::forward_iterator_tag;
    using value_type = char;
    using difference_type = std::ptrdiff_t;
    using pointer = const char*;
    using reference = const char&;
    // NOLINTEND(readability-identifier-naming)

    Place(const char* at, const char** reached) : at_(at), reached_(reached) {}
    reference operator*() const { return *at_; }
    Place& operator++() {
        *reached_ = ++at_;
        return *this;
    }
    Place operator++(int) {
        const Place before = *this;
        ++*this;
        return before;
    }
    friend bool operator==(const Place& l, const Place& r) { return l.at_ == r.at_; }
    friend bool operator!=(const Place& l, const Place& r) { return l.at_ != r.at_; }

private:
    const char* at_;
    const char** reached_;
};

/// A JSON text in which some of its strings are replaced, in order.
class Respelling {
public:
    explicit Respelling(std::string_view text) : text_(text), reached_(text.data()) {}

    [[nodiscard]] Place begin() { return {text_.data(), &reached_}; }
    [[nodiscard]] Place end() { return {text_.data() + text_.size(), &reached_}; }

    /// Of the string that the lexer has just taken, to its closing quote. \pre there is no " in it, nor an escaped one.
    void replace_last(const std::string& name) {
        const auto quote = static_cast<std::size_t>(reached_ - text_.data()) - 1;
        const std::size_t first = text_.rfind('"', quote - 1) + 1;
        made_.append(text_, copied_, first - copied_).append(name);
        copied_ = quote;
    }

    [[nodiscard]] std::string made() && { return std::move(made_.append(text_, copied_)); }

private:
    const std::string_view text_;
    const char* reached_;
    std::string made_;
    std::size_t copied_ = 0;
};

}  // namespace vsplit::wire

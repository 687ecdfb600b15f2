#include "io/number_stream.h"

#include <algorithm>
#include <cmath>

#include "io/text_lines.h"

namespace vsplit {
namespace {

bool is_white(std::byte b) {
    const auto c = static_cast<char>(b);
    return c == ' ' || (c >= '\t' && c <= '\r');
}

constexpr double kLargestExact = 9007199254740992;  // 2^53: integers are kept in doubles

}  // namespace

void NumberStream::skip_space() {
    for (; at_ < bytes_.size() && is_white(bytes_[at_]); ++at_) line_ += static_cast<char>(bytes_[at_]) == '\n' ? 1 : 0;
}

bool NumberStream::more() {
    skip_space();
    return at_ < bytes_.size();
}

std::string_view NumberStream::word() {
    skip_space();
    last_ = at_;
    while (at_ < bytes_.size() && !is_white(bytes_[at_])) ++at_;
    return as_text(bytes_.subspan(last_, at_ - last_));
}

std::string_view NumberStream::line() {
    last_ = at_;
    while (at_ < bytes_.size() && static_cast<char>(bytes_[at_]) != '\n') ++at_;
    std::string_view text = as_text(bytes_.subspan(last_, at_ - last_));
    if (at_ < bytes_.size()) {
        ++at_;
        ++line_;
    }
    if (text.ends_with('\r')) text.remove_suffix(1);
    return text;
}

void NumberStream::end_line() {
    if (at_ < bytes_.size() && static_cast<char>(bytes_[at_]) == '\r') ++at_;
    if (at_ < bytes_.size() && static_cast<char>(bytes_[at_]) == '\n') {
        ++at_;
        ++line_;
    }
}

void NumberStream::skip_past_line(std::string_view text) {
    while (at_ < bytes_.size()) {
        if (trimmed(line()) == text) return;
    }
    fail(Cause::kTruncatedInput, "the file ends before " + quoted(text));
}

double NumberStream::number(Kind kind, const char* what) {
    if (!ok()) return 0;
    if (!binary_) {
        const std::string_view text = word();
        const std::optional<double> value = parse_number(text);
        if (value) return *value;
        if (text.empty()) {
            fail(Cause::kTruncatedInput, "the file ends where " + std::string(what) + " should follow");
        } else {
            fail(Cause::kMalformedInput, "expected " + std::string(what) + ", " + found(text));
        }
        return 0;
    }
    last_ = at_;
    const std::size_t size = size_of(kind);
    if (left() < size) {
        fail(Cause::kTruncatedInput, "the file ends where " + std::string(what) + " should follow");
        return 0;
    }
    at_ += size;
    return load_number(bytes_.data() + last_, kind, order_);
}

std::int64_t NumberStream::integer(Kind kind, const char* what) {
    const double value = number(kind, what);
    if (std::abs(value) <= kLargestExact && value == std::trunc(value)) return static_cast<std::int64_t>(value);
    fail(Cause::kMalformedInput, "expected " + std::string(what) + ", an integer, found " + to_text(value));
    return 0;
}

std::uint64_t NumberStream::count(Kind kind, const char* what, std::uint64_t most) {
    const std::int64_t value = integer(kind, what);
    if (value >= 0 && static_cast<std::uint64_t>(value) <= most) return static_cast<std::uint64_t>(value);
    fail(Cause::kMalformedInput,
         "expected " + std::string(what) + ", 0 to " + std::to_string(most) + ", found " + std::to_string(value));
    return 0;
}

void NumberStream::expect(std::string_view expected) {
    if (!ok()) return;
    const std::string_view text = word();
    if (text == expected) return;
    const Place place = at_line(line_);
    if (text.empty()) return fail_at(place, Cause::kTruncatedInput, "the file ends where " + quoted(expected) + " should follow");
    fail_at(place, Cause::kMalformedInput, "expected " + quoted(expected) + ", " + found(text));
}

void NumberStream::fail(Cause cause, const std::string& what) { fail_at(place(), cause, what); }

void NumberStream::fail_at(Place place, Cause cause, const std::string& what) {
    if (ok()) error_ = read_error(cause, place, what);
}

bool NumberStream::keep(const Status& status) {
    if (!status && ok()) error_ = status.error();
    return ok();
}

}  // namespace vsplit

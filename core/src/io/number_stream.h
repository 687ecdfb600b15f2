#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "io/number_kind.h"
#include "io/read_error.h"
#include "vsplit/base/expected.h"

namespace vsplit {

/// A file of words and lines in which numbers may stand as bytes, and what went wrong first: after that every read gives zeros,
/// so that whoever reads asks `ok` where it matters, at least once a loop.
class NumberStream {
public:
    using Kind = NumberKind;

    explicit NumberStream(std::span<const std::byte> bytes) : bytes_(bytes) {}

    /// How numbers stand from here on; words always are text.
    void set_text() { binary_ = false; }
    void set_binary(std::endian order) {
        binary_ = true;
        order_ = order;
    }
    [[nodiscard]] bool is_binary() const { return binary_; }

    /// The next word, between white space; empty at the end of the file.
    [[nodiscard]] std::string_view word();
    /// The rest of the line, without its end; goes to the next line.
    [[nodiscard]] std::string_view line();
    /// Passes over one end of line, before bytes.
    void end_line();
    /// Passes over white space, and whether there is more. Not before bytes.
    [[nodiscard]] bool more();
    /// Goes behind the next line that is `text`; an error where there is none.
    void skip_past_line(std::string_view text);

    /// A number as it stands here; `kind` says how in bytes. In text an integer must have no fraction.
    [[nodiscard]] double number(Kind kind, const char* what);
    [[nodiscard]] std::int64_t integer(Kind kind, const char* what);
    /// An integer from 0 to `most`.
    [[nodiscard]] std::uint64_t count(Kind kind, const char* what, std::uint64_t most);

    /// Whether a word of text comes next that is `expected`; an error where not.
    void expect(std::string_view expected);

    [[nodiscard]] bool ok() const { return !error_; }
    [[nodiscard]] const Error& error() const { return *error_; }
    /// Keeps the first.
    void fail(Cause cause, const std::string& what);
    void fail_at(Place place, Cause cause, const std::string& what);
    /// Keeps the error of a status that failed; whether it was good.
    bool keep(const Status& status);

    /// The line of what was read last where it is text, the byte where it is bytes.
    [[nodiscard]] Place place() const { return binary_ ? at_byte(last_) : at_line(line_); }
    [[nodiscard]] std::size_t left() const { return bytes_.size() - at_; }

private:
    void skip_space();

    std::span<const std::byte> bytes_;
    std::size_t at_ = 0;
    std::size_t last_ = 0;  // where what was read last begins
    std::size_t line_ = 1;
    bool binary_ = false;
    std::endian order_ = std::endian::little;
    std::optional<Error> error_;
};

}  // namespace vsplit

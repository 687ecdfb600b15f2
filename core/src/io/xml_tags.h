#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/read_error.h"
#include "vsplit/base/expected.h"

namespace vsplit {

/// Where in a text one is.
class XmlPosition {
public:
    /// Goes past `text`.
    void pass(std::string_view text);
    /// The line; its column too where the line is too long to find a place in it by eye.
    [[nodiscard]] Place place() const;

private:
    std::size_t line_ = 1;
    std::size_t column_ = 1;
};

/// A tag of XML as files of meshes have it.
struct XmlTag {
    std::string_view name;
    bool ends = false;    ///< </Points>
    bool closed = false;  ///< <Points/>
    std::vector<std::pair<std::string_view, std::string_view>> attributes;
    Place place = at_line(1);
    std::size_t end = 0;  ///< byte behind the tag

    /// Empty when the tag has no such attribute.
    [[nodiscard]] std::string_view attribute(std::string_view key) const;
};

/// Tags one after the other; declarations and comments are passed over. Not a parser of all XML: whoever asks says where to stop
/// before bytes that are none.
class XmlTags {
public:
    /// `position`: of the text's begin.
    explicit XmlTags(std::string_view text, XmlPosition position = {}) : text_(text), position_(position) {}

    /// The next tag; empty at the end of the file. \return MALFORMED_INPUT, TRUNCATED_INPUT with the place.
    [[nodiscard]] Expected<std::optional<XmlTag>> next();

    /// The text from the last tag to the next.
    [[nodiscard]] std::string_view text_ahead() const { return text_.substr(at_, text_.find('<', at_) - at_); }
    /// Where that text begins.
    [[nodiscard]] const XmlPosition& position() const { return position_; }

private:
    [[nodiscard]] Status read_name(XmlTag& tag);
    [[nodiscard]] Status read_attributes(XmlTag& tag);
    [[nodiscard]] Status read_attribute(XmlTag& tag);
    void go_to(std::size_t at);
    void skip_space();

    std::string_view text_;
    std::size_t at_ = 0;
    XmlPosition position_;
};

/// Whether tags begin and end as XML has it: an end names the tag that is open, and one tag holds all others.
class XmlNesting {
public:
    /// \return MALFORMED_INPUT.
    [[nodiscard]] Status take(const XmlTag& tag);
    /// What may be at the file's end, `place`. \return TRUNCATED_INPUT where a tag is open.
    [[nodiscard]] Status end(Place place) const;

    /// Whether the tag that holds all has ended.
    [[nodiscard]] bool ended() const { return begun_ && open_.empty(); }

private:
    struct Open {
        std::string name;
        Place place;
    };
    std::vector<Open> open_;
    bool begun_ = false;
};

}  // namespace vsplit

#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "vsplit/base/expected.h"

namespace vsplit {

/// A tag of XML as files of meshes have it.
struct XmlTag {
    std::string_view name;  ///< "/Piece" for </Piece>
    bool closed = false;    ///< <Points/>
    std::vector<std::pair<std::string_view, std::string_view>> attributes;
    std::size_t line = 0;
    std::size_t end = 0;  ///< byte behind the tag

    /// Empty when the tag has no such attribute.
    [[nodiscard]] std::string_view attribute(std::string_view key) const;
};

/// Tags one after the other; declarations and comments are passed over. Not a parser of all XML: whoever asks says where to stop
/// before bytes that are none.
class XmlTags {
public:
    /// `line`: the number of the first.
    explicit XmlTags(std::string_view text, std::size_t line = 1) : text_(text), line_(line) {}

    /// The next tag; empty at the end of the file. \return MALFORMED_INPUT, TRUNCATED_INPUT with the line.
    [[nodiscard]] Expected<std::optional<XmlTag>> next();

    /// The text from the last tag to the next.
    [[nodiscard]] std::string_view text_ahead() const { return text_.substr(at_, text_.find('<', at_) - at_); }

private:
    [[nodiscard]] Status read_attributes(XmlTag& tag);
    void go_to(std::size_t at);
    void skip_space();

    std::string_view text_;
    std::size_t at_ = 0;
    std::size_t line_;
};

}  // namespace vsplit

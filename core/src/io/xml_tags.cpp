#include "io/xml_tags.h"

#include <algorithm>

#include "io/read_error.h"

namespace vsplit {
namespace {

constexpr std::string_view kSpace = " \t\r\n";

}  // namespace

std::string_view XmlTag::attribute(std::string_view key) const {
    const auto found = std::find_if(attributes.begin(), attributes.end(), [&](const auto& a) { return a.first == key; });
    return found == attributes.end() ? std::string_view() : found->second;
}

void XmlTags::go_to(std::size_t at) {
    at = std::min(at, text_.size());
    line_ += static_cast<std::size_t>(
        std::count(text_.begin() + static_cast<std::ptrdiff_t>(at_), text_.begin() + static_cast<std::ptrdiff_t>(at), '\n'));
    at_ = at;
}

void XmlTags::skip_space() { go_to(text_.find_first_not_of(kSpace, at_)); }

Expected<std::optional<XmlTag>> XmlTags::next() {
    for (;;) {
        go_to(text_.find('<', at_));
        if (at_ == text_.size()) return std::optional<XmlTag>();
        const bool comment = text_.substr(at_).starts_with("<!--");
        if (!comment && !text_.substr(at_).starts_with("<?") && !text_.substr(at_).starts_with("<!")) break;
        const std::size_t end = text_.find(comment ? "-->" : ">", at_);
        go_to(end == std::string_view::npos ? text_.size() : end + 1);
    }
    XmlTag tag;
    tag.attributes.reserve(4);
    tag.line = line_;
    go_to(at_ + 1);
    const std::size_t end = std::min(text_.find_first_of(" \t\r\n/>", at_ + 1), text_.size());
    tag.name = text_.substr(at_, end - at_);
    go_to(end);
    if (Status read = read_attributes(tag); !read) return read.error();
    tag.end = at_;
    return std::optional(std::move(tag));
}

Status XmlTags::read_attributes(XmlTag& tag) {
    for (;;) {
        skip_space();
        if (at_ == text_.size())
            return read_error(Cause::kTruncatedInput, at_line(line_), "the file ends within the tag " + quoted(tag.name));
        if (text_[at_] == '/') {
            tag.closed = true;
            go_to(at_ + 1);
            continue;
        }
        if (text_[at_] == '>') {
            go_to(at_ + 1);
            return Done{};
        }
        const std::size_t equals = text_.find_first_of("=<>", at_);
        const std::size_t open = equals == std::string_view::npos ? equals : text_.find_first_not_of(kSpace, equals + 1);
        const bool good = open != std::string_view::npos && text_[equals] == '=' && (text_[open] == '"' || text_[open] == '\'');
        const std::size_t close = good ? text_.find(text_[open], open + 1) : std::string_view::npos;
        if (close == std::string_view::npos) {
            return read_error(
                Cause::kMalformedInput, at_line(line_),
                "expected an attribute of " + quoted(tag.name) + " as name=\"value\", found " + quoted(text_.substr(at_, 20)));
        }
        std::string_view key = text_.substr(at_, equals - at_);
        key = key.substr(0, key.find_first_of(kSpace));
        tag.attributes.emplace_back(key, text_.substr(open + 1, close - open - 1));
        go_to(close + 1);
    }
}

}  // namespace vsplit

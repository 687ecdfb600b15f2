#include "io/xml_tags.h"

#include <algorithm>

namespace vsplit {
namespace {

constexpr std::string_view kSpace = " \t\r\n";
constexpr std::size_t kMostAttributes = 1000;  // each is compared with those before it; a tag of a mesh has ten

bool begins_name(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || c == ':' || static_cast<unsigned char>(c) >= 0x80;
}

}  // namespace

void XmlPosition::pass(std::string_view text) {
    const auto lines = static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
    line_ += lines;
    column_ = lines == 0 ? column_ + text.size() : text.size() - text.rfind('\n');
}

Place XmlPosition::place() const {
    constexpr std::size_t kByEye = 200;
    return at_line(line_, column_ > kByEye ? column_ : 0);
}

std::string_view XmlTag::attribute(std::string_view key) const {
    const auto found = std::find_if(attributes.begin(), attributes.end(), [&](const auto& a) { return a.first == key; });
    return found == attributes.end() ? std::string_view() : found->second;
}

void XmlTags::go_to(std::size_t at) {
    at = std::min(at, text_.size());
    position_.pass(text_.substr(at_, at - at_));
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
    tag.place = position_.place();
    if (Status read = read_name(tag); !read) return read.error();
    if (Status read = read_attributes(tag); !read) return read.error();
    tag.end = at_;
    return std::optional(std::move(tag));
}

Status XmlTags::read_name(XmlTag& tag) {
    go_to(at_ + 1);
    tag.ends = text_.substr(at_).starts_with('/');
    if (tag.ends) go_to(at_ + 1);
    const std::size_t end = std::min(text_.find_first_of(" \t\r\n/>", at_), text_.size());
    tag.name = text_.substr(at_, end - at_);
    const bool is_name = begins_name(text_[std::min(at_, text_.size() - 1)]) && tag.name.find_first_of("=<\"'&") == tag.name.npos;
    if (at_ < text_.size() && !is_name)
        return read_error(Cause::kMalformedInput, tag.place, "expected a tag's name, found " + quoted(text_.substr(at_, 20)));
    go_to(end);
    return Done{};
}

Status XmlTags::read_attributes(XmlTag& tag) {
    for (;;) {
        skip_space();
        if (at_ == text_.size())
            return read_error(Cause::kTruncatedInput, position_.place(), "the file ends within the tag " + quoted(tag.name));
        tag.closed = text_[at_] == '/' && text_.substr(at_ + 1).starts_with('>');
        if (tag.closed && !tag.ends) go_to(at_ + 1);
        if (text_[at_] == '>') {
            go_to(at_ + 1);
            return Done{};
        }
        if (Status read = read_attribute(tag); !read) return read;
    }
}

Status XmlTags::read_attribute(XmlTag& tag) {
    const auto wrong = [&](const std::string& what) { return read_error(Cause::kMalformedInput, position_.place(), what); };
    const std::string_view here = text_.substr(at_, 20);
    if (tag.ends) return wrong("expected '>' behind the end of " + quoted(tag.name) + ", found " + quoted(here));
    const std::size_t equals = text_.find_first_of("=<>", at_);
    const std::size_t open = equals == std::string_view::npos ? equals : text_.find_first_not_of(kSpace, equals + 1);
    const bool good = open != std::string_view::npos && text_[equals] == '=' && (text_[open] == '"' || text_[open] == '\'');
    const std::size_t close = good ? text_.find(text_[open], open + 1) : std::string_view::npos;
    std::string_view key = text_.substr(at_, good ? equals - at_ : 0);
    key = key.substr(0, key.find_last_not_of(kSpace) + 1);
    if (close == std::string_view::npos || key.empty() || !begins_name(key.front()) ||
        key.find_first_of(kSpace) != std::string_view::npos)
        return wrong("expected an attribute of " + quoted(tag.name) + " as name=\"value\", found " + quoted(here));
    if (tag.attributes.size() == kMostAttributes)
        return wrong("a tag " + quoted(tag.name) + " has over " + std::to_string(kMostAttributes) + " attributes");
    const auto same = [key](const auto& attribute) { return attribute.first == key; };
    if (std::any_of(tag.attributes.begin(), tag.attributes.end(), same))
        return wrong("the attribute " + quoted(key) + " of " + quoted(tag.name) + " is there twice");
    tag.attributes.emplace_back(key, text_.substr(open + 1, close - open - 1));
    go_to(close + 1);
    return Done{};
}

Status XmlNesting::take(const XmlTag& tag) {
    constexpr std::size_t kDeepest = 1000;
    if (!tag.ends) {
        if (ended())
            return read_error(Cause::kMalformedInput, tag.place, "a tag " + quoted(tag.name) + " follows the end of the XML");
        begun_ = true;
        if (tag.closed) return Done{};
        if (open_.size() == kDeepest)
            return read_error(Cause::kMalformedInput, tag.place, "tags are over " + std::to_string(kDeepest) + " deep");
        open_.push_back({std::string(tag.name), tag.place});
        return Done{};
    }
    const std::string end = quoted("</" + std::string(tag.name) + ">");
    if (open_.empty()) return read_error(Cause::kMalformedInput, tag.place, end + " ends a tag that was not begun");
    if (open_.back().name != tag.name) {
        return read_error(Cause::kMalformedInput, tag.place,
                          "expected " + quoted("</" + open_.back().name + ">") + ", the end of the tag of line " +
                              std::to_string(open_.back().place.number) + ", found " + end);
    }
    open_.pop_back();
    return Done{};
}

Status XmlNesting::end(Place place) const {
    if (open_.empty()) return Done{};
    return read_error(Cause::kTruncatedInput, place, "the file ends before " + quoted("</" + open_.back().name + ">"));
}

}  // namespace vsplit

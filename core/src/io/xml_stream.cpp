#include "io/xml_stream.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <utility>

#include "io/read_error.h"
#include "io/text_lines.h"

namespace vsplit {
namespace {

constexpr std::size_t kLongestTag = std::size_t{1} << 20U;
constexpr std::size_t kLongestReference = 12;  // &#x0010FFFF;

/// What a piece of markup begins and ends with, where that is no tag.
struct Passed {
    std::string_view begin;
    std::string_view end;
};
constexpr std::array<Passed, 3> kPassed = {{{"<!--", "-->"}, {"<![CDATA[", "]]>"}, {"<?", "?>"}}};

/// Behind the '>' that ends the tag at `at`, which may stand in quotes before; npos where it is not there yet.
std::size_t tag_end(std::string_view text, std::size_t at) {
    for (;;) {
        at = text.find_first_of(">\"'", at);
        if (at == std::string_view::npos) return at;
        if (text[at] == '>') return at + 1;
        at = text.find(text[at], at + 1);
        if (at == std::string_view::npos) return at;
        ++at;
    }
}

void append_utf8(std::string& text, std::uint32_t code) {
    const auto tail = [&](unsigned shift) { text += static_cast<char>(0x80U | (code >> shift & 0x3FU)); };
    if (code < 0x80) {
        text += static_cast<char>(code);
    } else if (code < 0x800) {
        text += static_cast<char>(0xC0U | code >> 6U);
        tail(0);
    } else if (code < 0x10000) {
        text += static_cast<char>(0xE0U | code >> 12U);
        tail(6);
        tail(0);
    } else {
        text += static_cast<char>(0xF0U | code >> 18U);
        tail(12);
        tail(6);
        tail(0);
    }
}

/// The character that "amp", "#65" or "#x41" names; 0 where it names none.
std::uint32_t character_of(std::string_view name) {
    constexpr std::array<std::pair<std::string_view, char>, 5> kNames = {
        {{"amp", '&'}, {"lt", '<'}, {"gt", '>'}, {"quot", '"'}, {"apos", '\''}}};
    for (const auto& [known, character] : kNames) {
        if (known == name) return static_cast<std::uint32_t>(character);
    }
    if (!name.starts_with('#')) return 0;
    name.remove_prefix(1);
    const bool hexadecimal = name.starts_with('x');
    if (hexadecimal) name.remove_prefix(1);
    std::uint32_t code = 0;
    const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), code, hexadecimal ? 16 : 10);
    const bool whole = error == std::errc() && end == name.data() + name.size();
    const bool surrogate = code >= 0xD800 && code < 0xE000;
    return whole && !surrogate && code < 0x110000 ? code : 0;
}

/// Bytes of the UTF-8 character that `text` begins with; 0 where it begins with none.
std::size_t utf8_length(std::string_view text) {
    const auto byte = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U; };
    const auto is_tail = [&](std::size_t i) { return (byte(i) & 0xC0U) == 0x80U; };
    if (byte(0) < 0x80) return 1;
    if (byte(0) >= 0xC2 && byte(0) < 0xE0) return is_tail(1) ? 2 : 0;
    const bool overlong = (byte(0) == 0xE0 && byte(1) < 0xA0) || (byte(0) == 0xF0 && byte(1) < 0x90);
    const bool beyond = (byte(0) == 0xED && byte(1) > 0x9F) || (byte(0) == 0xF4 && byte(1) > 0x8F) || byte(0) > 0xF4;
    if (byte(0) < 0xE0 || overlong || beyond) return 0;
    if (byte(0) < 0xF0) return is_tail(1) && is_tail(2) ? 3 : 0;
    return is_tail(1) && is_tail(2) && is_tail(3) ? 4 : 0;
}

void append_escaped(std::string& text, char c) {
    switch (c) {
        case '&':
            text += "&amp;";
            break;
        case '<':
            text += "&lt;";
            break;
        case '>':
            text += "&gt;";
            break;
        case '"':
            text += "&quot;";
            break;
        default:
            text += static_cast<unsigned char>(c) < ' ' || c == '\x7F' ? '_' : c;
    }
}

}  // namespace

void XmlStream::go_to(std::size_t at) {
    position_.pass(std::string_view(text_).substr(at_, at - at_));
    at_ = at;
}

/// Goes to `at` over what is no markup.
Status XmlStream::go_over_text(std::size_t at) {
    const std::string_view text = trimmed(std::string_view(text_).substr(at_, at - at_));
    if (nesting_.ended() && !text.empty())
        return read_error(Cause::kMalformedInput, position_.place(), "text follows the end of the XML: " + quoted(text));
    go_to(at);
    return Done{};
}

/// More text; false at the end of the file.
Expected<bool> XmlStream::read_on() {
    if (ended_) return false;
    const Expected<std::string_view> piece = bytes_.next();
    if (!piece) return piece.error();
    ended_ = piece->empty();
    text_.erase(0, std::exchange(at_, 0));
    text_ += *piece;
    const bool first = !std::exchange(begun_, true);
    if (first && (text_.starts_with("\xFF\xFE") || text_.starts_with("\xFE\xFF")))
        return read_error(Cause::kUnsupported, at_line(1), "XML in UTF-16 is not read; UTF-8 is");
    return !ended_;
}

/// Goes to the next '<'; false at the end of the file.
Expected<bool> XmlStream::find_opening() {
    for (;;) {
        const std::size_t open = text_.find('<', at_);
        if (open != std::string::npos) {
            if (Status passed = go_over_text(open); !passed) return passed.error();
            return true;
        }
        if (Status passed = go_over_text(text_.size()); !passed) return passed.error();
        Expected<bool> more = read_on();
        if (!more || !*more) return more;
    }
}

/// Behind the markup that begins here.
Expected<std::size_t> XmlStream::find_end() {
    for (;;) {
        const std::string_view rest = std::string_view(text_).substr(at_);
        std::size_t end = std::string_view::npos;
        if (rest.starts_with("<!") || rest.starts_with("<?")) {
            for (const Passed& passed : kPassed) {
                if (!rest.starts_with(passed.begin)) continue;
                end = rest.find(passed.end, passed.begin.size());
                if (end != std::string_view::npos) end += passed.end.size();
            }
            if (rest.starts_with("<!D"))
                return read_error(Cause::kMalformedInput, position_.place(), "a document type is not allowed here");
        } else {
            end = tag_end(rest, 1);
        }
        if (end != std::string_view::npos) return at_ + end;
        if (rest.size() > kLongestTag) {
            return read_error(
                Cause::kMalformedInput, position_.place(),
                "a tag or comment has over " + std::to_string(kLongestTag) + " bytes: " + quoted(rest.substr(0, 20)));
        }
        const Expected<bool> more = read_on();
        if (!more) return more.error();
        if (!*more) {
            return read_error(Cause::kTruncatedInput, position_.place(),
                              "the file ends within " + quoted(std::string_view(text_).substr(at_, 20)));
        }
    }
}

Expected<std::optional<XmlTag>> XmlStream::next() {
    for (;;) {
        const Expected<bool> opened = find_opening();
        if (!opened) return opened.error();
        if (!*opened) {
            if (Status ended = nesting_.end(position_.place()); !ended) return ended.error();
            return std::optional<XmlTag>();
        }
        const Expected<std::size_t> end = find_end();
        if (!end) return end.error();
        const std::string_view markup = std::string_view(text_).substr(at_, *end - at_);
        const XmlPosition begin = position_;
        go_to(*end);
        if (markup.starts_with("<!") || markup.starts_with("<?")) continue;
        Expected<std::optional<XmlTag>> tag = XmlTags(markup, begin).next();
        if (!tag || !*tag) return tag;
        if (Status nests = nesting_.take(**tag); !nests) return nests.error();
        return tag;
    }
}

std::string xml_unescaped(std::string_view text) {
    std::string result;
    while (!text.empty()) {
        const std::size_t end = text.front() == '&' ? text.substr(0, kLongestReference).find(';') : std::string_view::npos;
        const std::uint32_t code = end == std::string_view::npos ? 0 : character_of(text.substr(1, end - 1));
        if (code != 0) {
            append_utf8(result, code);
            text.remove_prefix(end + 1);
            continue;
        }
        result += text.front();
        text.remove_prefix(1);
    }
    return result;
}

std::string xml_escaped(std::string_view name) {
    std::string text;
    while (!name.empty()) {
        const std::size_t length = utf8_length(name);
        if (length == 1) append_escaped(text, name.front());
        if (length == 0) append_utf8(text, static_cast<unsigned char>(name.front()));
        if (length > 1) text += name.substr(0, length);
        name.remove_prefix(std::max<std::size_t>(1, length));
    }
    return text;
}

}  // namespace vsplit

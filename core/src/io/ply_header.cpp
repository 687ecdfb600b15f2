#include "io/ply_header.h"

#include <algorithm>
#include <array>
#include <optional>

#include "io/text_lines.h"

namespace vsplit {
namespace {

struct TypeName {
    std::string_view name;
    std::string_view old_name;
    PlyType type;
};

constexpr std::array<TypeName, 8> kTypes = {{{"int8", "char", PlyType::kInt8},
                                             {"uint8", "uchar", PlyType::kUint8},
                                             {"int16", "short", PlyType::kInt16},
                                             {"uint16", "ushort", PlyType::kUint16},
                                             {"int32", "int", PlyType::kInt32},
                                             {"uint32", "uint", PlyType::kUint32},
                                             {"float32", "float", PlyType::kFloat32},
                                             {"float64", "double", PlyType::kFloat64}}};

std::optional<PlyType> type_by_name(std::string_view name) {
    const auto* const match = std::find_if(kTypes.begin(), kTypes.end(),
                                           [&](const TypeName& type) { return type.name == name || type.old_name == name; });
    if (match == kTypes.end()) return {};
    return match->type;
}

class HeaderParser {
public:
    explicit HeaderParser(std::string_view text) : text_(text), lines_(text) {}

    Expected<PlyHeader> parse() {
        if (!lines_.next() || lines_.line() != "ply") return malformed("expected 'ply'").error();
        while (lines_.next()) {
            std::string_view rest = lines_.line();
            const std::string_view keyword = next_word(rest);
            if (keyword == "end_header") return finish();
            const Status status = parse_line(keyword, rest);
            if (!status && !lines_.rest().empty()) return status.error();  // else the last line is cut off
        }
        return read_error(Cause::kTruncatedInput, at_line(lines_.number()), "the file ends before 'end_header'");
    }

private:
    Status parse_line(std::string_view keyword, std::string_view rest) {
        if (keyword == "format") return parse_format(rest);
        if (keyword == "element") return parse_element(rest);
        if (keyword == "property") return parse_property(rest);
        if (keyword.empty() || keyword == "comment" || keyword == "obj_info") return Done{};
        return malformed("expected 'format', 'element', 'property', 'comment' or 'end_header', " + found(keyword));
    }

    Status parse_format(std::string_view rest) {
        const std::string_view name = next_word(rest);
        const std::string_view version = next_word(rest);
        if (version != "1.0") return malformed("expected version 1.0 of PLY, " + found(version));
        format_seen_ = true;
        if (name == "ascii") {
            header_.encoding = PlyEncoding::kAscii;
        } else if (name == "binary_little_endian") {
            header_.encoding = PlyEncoding::kLittleEndian;
        } else if (name == "binary_big_endian") {
            header_.encoding = PlyEncoding::kBigEndian;
        } else {
            return malformed("expected 'ascii', 'binary_little_endian' or 'binary_big_endian', " + found(name));
        }
        return Done{};
    }

    Status parse_element(std::string_view rest) {
        const std::string_view name = next_word(rest);
        const std::string_view count = next_word(rest);
        const std::optional<std::int64_t> value = parse_integer(count);
        if (!value || *value < 0) return malformed("expected how many rows the element has, " + found(count));
        const bool repeated = std::any_of(header_.elements.begin(), header_.elements.end(),
                                          [&](const PlyElement& element) { return element.name == name; });
        if (repeated) return malformed("element " + quoted(name) + " is announced twice");
        constexpr std::size_t kMostElements = 1000;  // each is compared with those before it
        if (header_.elements.size() == kMostElements) return malformed("more than 1000 elements are announced");
        header_.elements.push_back({std::string(name), static_cast<std::uint64_t>(*value), {}, lines_.number()});
        return Done{};
    }

    Status parse_property(std::string_view rest) {
        if (header_.elements.empty()) return malformed("a property stands before the first element");
        PlyProperty property;
        std::string_view word = next_word(rest);
        property.is_list = word == "list";
        if (property.is_list) {
            const std::string_view count = next_word(rest);
            const std::optional<PlyType> type = type_by_name(count);
            if (!type || !is_integer(*type)) return malformed("expected an integer type for a list's length, " + found(count));
            property.count_type = *type;
            word = next_word(rest);
        }
        const std::optional<PlyType> type = type_by_name(word);
        if (!type) return malformed("expected a type such as 'float' or 'uint8', " + found(word));
        property.type = *type;
        property.name = next_word(rest);
        if (property.name.empty()) return malformed("a property has no name");
        header_.elements.back().properties.push_back(std::move(property));
        return Done{};
    }

    Expected<PlyHeader> finish() {
        if (!format_seen_) return malformed("the header ends without a 'format' line").error();
        header_.lines = lines_.number();
        header_.body_offset = text_.size() - lines_.rest().size();
        return std::move(header_);
    }

    [[nodiscard]] Status malformed(std::string_view what) const {
        return read_error(Cause::kMalformedInput, at_line(lines_.number()), what);
    }

    std::string_view text_;
    TextLines lines_;
    bool format_seen_ = false;
    PlyHeader header_;
};

}  // namespace

std::size_t PlyElement::least_bytes(PlyEncoding encoding) const {
    std::size_t bytes = 0;
    for (const PlyProperty& property : properties) {
        const std::size_t binary = size_of(property.is_list ? property.count_type : property.type);
        bytes += encoding == PlyEncoding::kAscii ? 2 : binary;  // a digit and what divides it from the next
    }
    return bytes;
}

Expected<PlyHeader> parse_ply_header(std::string_view text) { return HeaderParser(text).parse(); }

}  // namespace vsplit

#include "wire/json_value.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

#include "wire/enum_value.h"

namespace vsplit::wire {
namespace pb = google::protobuf;
using Field = pb::FieldDescriptor;

namespace {

template <class Number>
std::optional<Number> parse(std::string_view text) {
    Number value{};
    const auto [end, failed] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (failed != std::errc() || end != text.data() + text.size()) return std::nullopt;
    return value;
}

// 5, 5.0 and "5" are whole numbers; in a text, digits alone.
template <class Number>
struct IsWhole {
    bool operator()(std::int64_t value) const { return std::in_range<Number>(value); }
    bool operator()(std::uint64_t value) const { return std::in_range<Number>(value); }
    bool operator()(double value) const {
        using Limits = std::numeric_limits<Number>;
        // The largest of 64 bits has no double; the power of two beyond it has.
        const double end = std::ldexp(1.0, Limits::digits);
        return value == std::floor(value) && value < end && value >= (Limits::is_signed ? -end : 0.0);
    }
    bool operator()(const std::string& value) const { return parse<Number>(value).has_value(); }
    template <class Other>
    bool operator()(const Other& /*null, bool*/) const {
        return false;
    }
};

// "NaN" and the like are texts.
template <class Number>
struct IsNumber {
    bool operator()(std::int64_t /*any*/) const { return true; }
    bool operator()(std::uint64_t /*any*/) const { return true; }
    bool operator()(double value) const { return std::abs(value) <= std::numeric_limits<Number>::max(); }
    bool operator()(const std::string& value) const {
        if (value == "NaN" || value == "Infinity" || value == "-Infinity") return true;
        const std::optional<double> number = parse<double>(value);
        return number && (*this)(*number);
    }
    template <class Other>
    bool operator()(const Other& /*null, bool*/) const {
        return false;
    }
};

bool is_enumerator(const pb::EnumDescriptor& type, const JsonScalar& value) {
    const auto* const name = std::get_if<std::string>(&value);
    if (name == nullptr) return std::visit(IsWhole<std::int32_t>(), value);
    if (find_value(type, *name) != nullptr) return true;
    const std::optional<std::int32_t> number = parse<std::int32_t>(*name);
    return number && type.FindValueByNumber(*number) != nullptr;
}

// Either alphabet of RFC 4648, and whether there is padding or not.
bool is_base64(std::string_view text) {
    while (!text.empty() && text.back() == '=') text.remove_suffix(1);
    return text.size() % 4 != 1 && std::all_of(text.begin(), text.end(), [](char c) {
               return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '+' || c == '/' ||
                      c == '-' || c == '_';
           });
}

bool is_text(const Field& field, const JsonScalar& value) {
    const auto* const text = std::get_if<std::string>(&value);
    return text != nullptr && (field.type() != Field::TYPE_BYTES || is_base64(*text));
}

}  // namespace

bool takes_value(const Field& field, const JsonScalar& value) {
    switch (field.cpp_type()) {
        case Field::CPPTYPE_INT32:
            return std::visit(IsWhole<std::int32_t>(), value);
        case Field::CPPTYPE_INT64:
            return std::visit(IsWhole<std::int64_t>(), value);
        case Field::CPPTYPE_UINT32:
            return std::visit(IsWhole<std::uint32_t>(), value);
        case Field::CPPTYPE_UINT64:
            return std::visit(IsWhole<std::uint64_t>(), value);
        case Field::CPPTYPE_DOUBLE:
            return std::visit(IsNumber<double>(), value);
        case Field::CPPTYPE_FLOAT:
            return std::visit(IsNumber<float>(), value);
        case Field::CPPTYPE_BOOL:
            return std::holds_alternative<bool>(value);
        case Field::CPPTYPE_ENUM:
            return is_enumerator(*field.enum_type(), value);
        case Field::CPPTYPE_STRING:
            return is_text(field, value);
        case Field::CPPTYPE_MESSAGE:
            break;
    }
    return false;
}

std::string text_of(const JsonScalar& value) {
    struct Text {
        std::string operator()(std::nullptr_t) const { return "null"; }
        std::string operator()(bool value) const { return value ? "true" : "false"; }
        std::string operator()(std::int64_t value) const { return std::to_string(value); }
        std::string operator()(std::uint64_t value) const { return std::to_string(value); }
        std::string operator()(double value) const {
            std::array<char, 32> text{};
            char* const end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
            return {text.data(), static_cast<std::size_t>(end - text.data())};
        }
        std::string operator()(const std::string& value) const { return '"' + value + '"'; }
    };
    return std::visit(Text(), value);
}

}  // namespace vsplit::wire

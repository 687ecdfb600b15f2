#include "rest/request_fields.h"

#include <google/protobuf/descriptor.h>

#include <charconv>
#include <cmath>
#include <cstdint>
#include <string>
#include <system_error>

#include "wire/enum_value.h"
#include "wire/field.h"
#include "wire/json.h"
#include "wire/utf8.h"

namespace vsplit::rest {
namespace pb = google::protobuf;
using Field = pb::FieldDescriptor;

namespace {

constexpr std::size_t kQuotedBytes = 100;

std::string quoted(std::string_view text) { return '"' + wire::valid_utf8(text, kQuotedBytes) + '"'; }

template <class Number>
bool parse(std::string_view text, Number& value) {
    const auto [end, failed] = std::from_chars(text.data(), text.data() + text.size(), value);
    return failed == std::errc() && end == text.data() + text.size();
}

// Sets or adds, as the field is.
class FieldWriter {
public:
    FieldWriter(pb::Message& message, const Field& field, std::string_view name, std::string_view text)
        : message_(message), field_(field), name_(name), text_(text) {}

    [[nodiscard]] Status write() const {
        using Reflection = pb::Reflection;
        switch (field_.cpp_type()) {
            case Field::CPPTYPE_INT32:
                return number<std::int32_t>(&Reflection::GetInt32, &Reflection::SetInt32, &Reflection::AddInt32);
            case Field::CPPTYPE_INT64:
                return number<std::int64_t>(&Reflection::GetInt64, &Reflection::SetInt64, &Reflection::AddInt64);
            case Field::CPPTYPE_UINT32:
                return number<std::uint32_t>(&Reflection::GetUInt32, &Reflection::SetUInt32, &Reflection::AddUInt32);
            case Field::CPPTYPE_UINT64:
                return number<std::uint64_t>(&Reflection::GetUInt64, &Reflection::SetUInt64, &Reflection::AddUInt64);
            case Field::CPPTYPE_DOUBLE:
                return number<double>(&Reflection::GetDouble, &Reflection::SetDouble, &Reflection::AddDouble);
            case Field::CPPTYPE_FLOAT:
                return number<float>(&Reflection::GetFloat, &Reflection::SetFloat, &Reflection::AddFloat);
            case Field::CPPTYPE_BOOL:
                return boolean();
            case Field::CPPTYPE_ENUM:
                return enumerator();
            case Field::CPPTYPE_STRING:
                return string();
            case Field::CPPTYPE_MESSAGE:
                break;
        }
        return well_known();
    }

private:
    template <class Value, class Get, class Set, class Add>
    Status put(Get get, Set set, Add add, const Value& value) const {
        const pb::Reflection& reflection = *message_.GetReflection();
        if (field_.is_repeated()) {
            (reflection.*add)(&message_, &field_, value);
            return Done{};
        }
        if (reflection.HasField(message_, &field_) && (reflection.*get)(message_, &field_) != value) return contradiction();
        (reflection.*set)(&message_, &field_, value);
        return Done{};
    }

    [[nodiscard]] Error contradiction() const {
        const std::string name = wire::valid_utf8(name_, kQuotedBytes);
        return {Cause::kInvalidOption,
                name + " is said more than once, here as " + quoted(text_) +
                    " and elsewhere as something else; accepted is one value in path, query and body together",
                name};
    }

    [[nodiscard]] Error refusal() const { return wire::bad_value(name_, quoted(text_), wire::accepted_values(field_)); }

    template <class Number, class Get, class Set, class Add>
    Status number(Get get, Set set, Add add) const {
        Number value{};
        if (!parse(text_, value)) return refusal();
        return put(get, set, add, value);
    }

    Status boolean() const {
        if (text_ != "true" && text_ != "false") return refusal();
        return put(&pb::Reflection::GetBool, &pb::Reflection::SetBool, &pb::Reflection::AddBool, text_ == "true");
    }

    Status enumerator() const {
        const pb::EnumDescriptor& type = *field_.enum_type();
        const pb::EnumValueDescriptor* value = wire::find_value(type, text_);
        int number = 0;
        if (value == nullptr && parse(text_, number)) value = type.FindValueByNumber(number);
        if (value != nullptr) {
            return put(&pb::Reflection::GetEnumValue, &pb::Reflection::SetEnumValue, &pb::Reflection::AddEnumValue,
                       value->number());
        }
        return refusal();
    }

    Status string() const {
        if (field_.type() == Field::TYPE_BYTES) {
            return Error{Cause::kInvalidOption, std::string(name_) + " is bytes, which belong into the body", std::string(name_)};
        }
        // The contract's strings are UTF-8; what is not would fail far from here with other words.
        return put(&pb::Reflection::GetString, &pb::Reflection::SetString, &pb::Reflection::AddString,
                   wire::valid_utf8(text_, text_.size() + 3));
    }

    Status well_known() const {
        const pb::Reflection& reflection = *message_.GetReflection();
        pb::Message& value =
            field_.is_repeated() ? *reflection.AddMessage(&message_, &field_) : *reflection.MutableMessage(&message_, &field_);
        const bool quotable = text_.find_first_of("\"\\") == std::string_view::npos;
        if (quotable && wire::from_json('"' + std::string(text_) + '"', value)) return Done{};
        return refusal();
    }

    pb::Message& message_;
    const Field& field_;
    const std::string_view name_;
    const std::string_view text_;
};

}  // namespace

Status set_field(pb::Message& message, std::string_view name, std::string_view text) {
    pb::Message* owner = &message;
    std::string_view rest = name;
    for (;;) {
        const std::size_t dot = rest.find('.');
        const Field* const field = wire::find_field(*owner->GetDescriptor(), rest.substr(0, dot));
        if (field == nullptr) return wire::unknown_field(name, *owner->GetDescriptor());
        if (dot == std::string_view::npos) return FieldWriter(*owner, *field, name, text).write();
        if (field->cpp_type() != Field::CPPTYPE_MESSAGE || field->is_repeated()) {
            return wire::unknown_field(name, *owner->GetDescriptor());
        }
        owner = owner->GetReflection()->MutableMessage(owner, field);
        rest.remove_prefix(dot + 1);
    }
}

}  // namespace vsplit::rest

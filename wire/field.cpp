#include "wire/field.h"

#include "wire/enum_value.h"
#include "wire/utf8.h"

namespace vsplit::wire {
namespace pb = google::protobuf;
using Field = pb::FieldDescriptor;

namespace {

constexpr std::size_t kQuotedBytes = 100;

std::string names_of(const pb::EnumDescriptor& type) {
    std::string names;
    for (int i = 0; i < type.value_count(); ++i) {
        names += (i == 0 ? "" : ", ") + type.value(i)->name();
        const std::string_view symbol = symbol_of(*type.value(i));
        if (!symbol.empty()) names.append(" (").append(symbol).append(")");
    }
    return names;
}

// Durations and times, which JSON writes as a text, are protobuf's own.
std::string values_of(const pb::Descriptor& type) {
    if (type.file()->package() == "google.protobuf") return "what JSON writes for a " + type.full_name();
    return "an object; a query names its fields with a dot";
}

}  // namespace

const Field* find_field(const pb::Descriptor& type, std::string_view name) {
    for (int i = 0; i < type.field_count(); ++i) {
        if (type.field(i)->name() == name || type.field(i)->json_name() == name) return type.field(i);
    }
    return nullptr;
}

std::string accepted_values(const Field& field) {
    switch (field.cpp_type()) {
        case Field::CPPTYPE_INT32:
            return "a whole number from -2147483648 to 2147483647";
        case Field::CPPTYPE_INT64:
            return "a whole number of 64 bits";
        case Field::CPPTYPE_UINT32:
            return "a whole number from 0 to 4294967295";
        case Field::CPPTYPE_UINT64:
            return "a whole number from 0 to 18446744073709551615";
        case Field::CPPTYPE_DOUBLE:
        case Field::CPPTYPE_FLOAT:
            return "a number";
        case Field::CPPTYPE_BOOL:
            return "true or false";
        case Field::CPPTYPE_ENUM:
            return "one of " + names_of(*field.enum_type());
        case Field::CPPTYPE_STRING:
            return field.type() == Field::TYPE_BYTES ? "base64 in a JSON body" : "text";
        case Field::CPPTYPE_MESSAGE:
            break;
    }
    return values_of(*field.message_type());
}

Error bad_value(std::string_view name, std::string_view value, const std::string& accepted) {
    const std::string field = valid_utf8(name, kQuotedBytes);
    return {Cause::kInvalidOption, field + " is " + valid_utf8(value, kQuotedBytes) + "; accepted is " + accepted, field};
}

Error unknown_field(std::string_view name, const pb::Descriptor& type) {
    std::string known;
    for (int i = 0; i < type.field_count(); ++i) known += (i == 0 ? "" : ", ") + type.field(i)->json_name();
    const std::string field = valid_utf8(name, kQuotedBytes);
    return {Cause::kInvalidOption,
            type.name() + " has no field \"" + field + '"' + (known.empty() ? "" : "; accepted are " + known), field};
}

}  // namespace vsplit::wire

#include "rest/json_schema.h"

#include <sstream>

#include "wire/enum_value.h"

namespace vsplit::rest {
namespace pb = google::protobuf;
using Field = pb::FieldDescriptor;

namespace {

std::string joined(const std::string& comment) {
    std::istringstream lines(comment);
    std::string text;
    std::string line;
    bool paragraph = false;
    while (std::getline(lines, line)) {
        const std::size_t first = line.find_first_not_of(' ');
        if (first == std::string::npos) {
            paragraph = !text.empty();
            continue;
        }
        if (!text.empty()) text += paragraph ? "\n\n" : " ";
        paragraph = false;
        text += line.substr(first);
    }
    return text;
}

// Well-known types that JSON writes as something else than an object; empty for others.
Json well_known(const std::string& name) {
    if (name == "google.protobuf.Timestamp") return {{"type", "string"}, {"format", "date-time"}};
    if (name == "google.protobuf.Duration") return {{"type", "string"}, {"pattern", R"(^-?[0-9]+(\.[0-9]+)?s$)"}};
    if (name == "google.protobuf.Any") return {{"type", "object"}, {"properties", {{"@type", {{"type", "string"}}}}}};
    return {};
}

Json component(const std::string& name) { return {{"$ref", "#/components/schemas/" + name}}; }

}  // namespace

template <class Descriptor>
std::string comment_of(const Descriptor& descriptor) {
    pb::SourceLocation location;
    return descriptor.GetSourceLocation(&location) ? joined(location.leading_comments) : std::string();
}

template std::string comment_of(const pb::Descriptor&);
template std::string comment_of(const pb::FieldDescriptor&);
template std::string comment_of(const pb::EnumDescriptor&);
template std::string comment_of(const pb::EnumValueDescriptor&);
template std::string comment_of(const pb::MethodDescriptor&);
template std::string comment_of(const pb::ServiceDescriptor&);

std::string first_sentence(const std::string& comment) {
    const std::size_t end = comment.find(". ");
    std::string sentence = comment.substr(0, std::min(end, comment.find("\n\n")));
    if (!sentence.empty() && sentence.back() == '.') sentence.pop_back();
    return sentence;
}

Json JsonSchemas::reference(const pb::Descriptor& type) {
    if (schemas_.count(type.name()) == 0) {
        schemas_[type.name()];  // first, for types that hold themselves
        Json made = well_known(type.full_name());
        if (made.is_null()) made = object(type);
        schemas_[type.name()] = std::move(made);
    }
    return component(type.name());
}

Json JsonSchemas::reference(const pb::EnumDescriptor& type) {
    if (schemas_.count(type.name()) == 0) {
        Json values = Json::array();
        std::string text = comment_of(type);
        for (int i = 0; i < type.value_count(); ++i) {
            values.push_back(type.value(i)->name());
            const std::string said = comment_of(*type.value(i));
            const std::string symbol(wire::symbol_of(*type.value(i)));
            if (said.empty() && symbol.empty()) continue;
            text += "\n\n" + type.value(i)->name() + (symbol.empty() ? "" : " (in requests also " + symbol + ")");
            if (!said.empty()) text += ": " + said;
        }
        schemas_[type.name()] = {{"type", "string"}, {"description", text}, {"enum", values}};
    }
    return component(type.name());
}

Json JsonSchemas::reference_double() {
    schemas_["Double"] = {{"description", "A number; what is no finite one is written as text."},
                          {"oneOf", {{{"type", "number"}}, {{"type", "string"}, {"enum", {"NaN", "Infinity", "-Infinity"}}}}}};
    return component("Double");
}

Json JsonSchemas::value(const Field& field) {
    switch (field.cpp_type()) {
        case Field::CPPTYPE_INT32:
            return {{"type", "integer"}, {"format", "int32"}};
        case Field::CPPTYPE_UINT32:
            return {{"type", "integer"}, {"minimum", 0}, {"maximum", 4294967295U}};
        case Field::CPPTYPE_INT64:
            return {{"type", "string"}, {"pattern", "^-?[0-9]+$"}};
        case Field::CPPTYPE_UINT64:
            return {{"type", "string"}, {"pattern", "^[0-9]+$"}};
        case Field::CPPTYPE_DOUBLE:
        case Field::CPPTYPE_FLOAT:
            return reference_double();
        case Field::CPPTYPE_BOOL:
            return {{"type", "boolean"}};
        case Field::CPPTYPE_ENUM:
            return reference(*field.enum_type());
        case Field::CPPTYPE_MESSAGE:
            return reference(*field.message_type());
        case Field::CPPTYPE_STRING:
            break;
    }
    if (field.type() == Field::TYPE_BYTES) return {{"type", "string"}, {"contentEncoding", "base64"}};
    return {{"type", "string"}};
}

Json JsonSchemas::field(const Field& field) {
    Json made;
    if (field.is_map()) {
        made = {{"type", "object"}, {"additionalProperties", value(*field.message_type()->map_value())}};
    } else if (field.is_repeated()) {
        made = {{"type", "array"}, {"items", value(field)}};
    } else {
        made = value(field);
    }
    const std::string text = comment_of(field);
    if (!text.empty()) made["description"] = text;
    return made;
}

Json JsonSchemas::object(const pb::Descriptor& type) {
    Json made{{"type", "object"}};
    std::string text = comment_of(type);
    for (int i = 0; i < type.real_oneof_decl_count(); ++i) {
        const pb::OneofDescriptor& oneof = *type.oneof_decl(i);
        text += text.empty() ? "One of " : "\n\nOne of ";
        for (int f = 0; f < oneof.field_count(); ++f) text += (f == 0 ? "" : ", ") + oneof.field(f)->json_name();
        text += '.';
    }
    if (!text.empty()) made["description"] = text;
    for (int i = 0; i < type.field_count(); ++i) made["properties"][type.field(i)->json_name()] = field(*type.field(i));
    return made;
}

Json JsonSchemas::all() const {
    Json made = Json::object();
    for (const auto& [name, schema] : schemas_) made[name] = schema;
    return made;
}

}  // namespace vsplit::rest

#pragma once

#include <google/protobuf/descriptor.h>

#include <map>
#include <nlohmann/json.hpp>
#include <string>

namespace vsplit::rest {

using Json = nlohmann::ordered_json;

/// The comment before a declaration, its lines joined; paragraphs stay apart. Empty where there is none.
template <class Descriptor>
[[nodiscard]] std::string comment_of(const Descriptor& descriptor);

/// Its first sentence.
[[nodiscard]] std::string first_sentence(const std::string& comment);

/// JSON Schemas of messages and enums as proto3 JSON writes them, each once, under the names they are referred to by.
class JsonSchemas {
public:
    /// {"$ref": ...}; the type and what it holds are there from now on.
    [[nodiscard]] Json reference(const google::protobuf::Descriptor& type);

    /// A field with its description, repeated ones as arrays.
    [[nodiscard]] Json field(const google::protobuf::FieldDescriptor& field);

    /// All that were referred to, by name.
    [[nodiscard]] Json all() const;

private:
    [[nodiscard]] Json value(const google::protobuf::FieldDescriptor& field);
    [[nodiscard]] Json reference(const google::protobuf::EnumDescriptor& type);
    [[nodiscard]] Json reference_double();
    [[nodiscard]] Json object(const google::protobuf::Descriptor& type);

    std::map<std::string, Json> schemas_;
};

}  // namespace vsplit::rest

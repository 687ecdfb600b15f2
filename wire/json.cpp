#include "wire/json.h"

#include <google/protobuf/util/json_util.h>

#include <algorithm>
#include <optional>
#include <string>

#include "wire/field.h"
#include "wire/utf8.h"

namespace vsplit::wire {
namespace pb = google::protobuf;

namespace {

std::string joined(std::string_view parent, std::string_view name) {
    return std::string(parent) + (parent.empty() || name.empty() ? "" : ".") + std::string(name);
}

// Follows a path like options.marked_edges[1] from a type on.
class Path {
public:
    Path(std::string_view path, const pb::Descriptor& type) : type_(&type) {
        while (type_ != nullptr && !path.empty()) step(path);
        if (!path.empty()) field_ = nullptr;
    }

    // As JSON writes it.
    [[nodiscard]] const std::string& json() const { return json_; }
    // The field that it ends at; null where it leads nowhere.
    [[nodiscard]] const pb::FieldDescriptor* field() const { return field_; }
    // The type of the message that it ends at; null where there is none.
    [[nodiscard]] const pb::Descriptor* type() const { return type_; }

private:
    void step(std::string_view& path) {
        const std::string_view part = path.substr(0, path.find('.'));
        path.remove_prefix(std::min(path.size(), part.size() + 1));
        const std::size_t index = std::min(part.find('['), part.size());
        field_ = find_field(*type_, part.substr(0, index));
        type_ = field_ == nullptr ? nullptr : field_->message_type();
        if (field_ != nullptr) json_ = joined(json_, field_->json_name()) + std::string(part.substr(index));
    }

    const pb::Descriptor* type_;
    const pb::FieldDescriptor* field_ = nullptr;
    std::string json_;
};

bool cut_end(std::string_view& text, std::string_view end) {
    if (text.size() < end.size() || text.substr(text.size() - end.size()) != end) return false;
    text.remove_suffix(end.size());
    return true;
}

// The error of the field at `path` that has this value; empty where there is no such field.
std::optional<Error> misfit(const std::string& path, std::string_view value, const pb::Descriptor& type) {
    const Path found(path, type);
    if (found.field() == nullptr) return std::nullopt;
    return bad_value(found.json(), value, accepted_values(*found.field()));
}

// What protobuf 3.21 says of JSON that is not the message's, with the field in words only:
//   (options.marked_edges[1]): invalid value 1.5 for type TYPE_UINT32
//   (options): invalid value Starting an object on a scalar field for type faces
//   (options) faces: Proto field is not repeating, cannot start list.
//   (options) faecs: Cannot find field.
// Empty for other words.
std::optional<Error> error_of_field(std::string_view said, const pb::Descriptor& type) {
    constexpr std::string_view kInvalid = ": invalid value ";
    constexpr std::string_view kType = " for type ";
    std::string_view parent;
    if (said.substr(0, 1) == "(") {
        parent = said.substr(1, said.find(')') - 1);
        said.remove_prefix(std::min(said.size(), parent.size() + 2));
        if (said.substr(0, 1) == " ") said.remove_prefix(1);
    }
    if (cut_end(said, ": Cannot find field.")) {
        const Path above(parent, type);
        if (above.type() == nullptr) return std::nullopt;
        return unknown_field(joined(above.json(), said), *above.type());
    }
    if (cut_end(said, ": Proto field is not repeating, cannot start list.")) {
        return misfit(joined(parent, said), "a list", type);
    }
    const std::size_t end = said.rfind(kType);
    if (said.substr(0, kInvalid.size()) != kInvalid || end == std::string_view::npos || end < kInvalid.size())
        return std::nullopt;
    const std::string_view value = said.substr(kInvalid.size(), end - kInvalid.size());
    if (value != "Starting an object on a scalar field") return misfit(std::string(parent), value, type);
    return misfit(joined(parent, said.substr(end + kType.size())), "an object", type);
}

}  // namespace

std::string to_json(const pb::Message& message, JsonStyle style) {
    pb::util::JsonPrintOptions options;
    options.always_print_primitive_fields = true;
    options.add_whitespace = style == JsonStyle::kIndented;
    std::string text;
    // Fails only for an Any of an unknown type; the contract has none.
    if (!pb::util::MessageToJsonString(message, &text, options).ok()) text.clear();
    return text;
}

Status from_json(std::string_view text, pb::Message& message, UnknownFields unknown) {
    pb::util::JsonParseOptions options;
    options.ignore_unknown_fields = unknown == UnknownFields::kIgnored;
    const auto parsed = pb::util::JsonStringToMessage({text.data(), text.size()}, &message, options);
    if (parsed.ok()) return Done{};
    const pb::Descriptor& type = *message.GetDescriptor();
    const std::string said(parsed.message().data(), parsed.message().size());
    if (std::optional<Error> error = error_of_field(said, type)) return *std::move(error);
    return Error{Cause::kMalformedInput, "not the JSON of a " + type.full_name() + ": " + valid_utf8(said, 500), ""};
}

}  // namespace vsplit::wire

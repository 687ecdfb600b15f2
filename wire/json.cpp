#include "wire/json.h"

#include <google/protobuf/util/json_util.h>

#include <string>

namespace vsplit::wire {
namespace pb = google::protobuf;

std::string to_json(const pb::Message& message, JsonStyle style) {
    pb::util::JsonPrintOptions options;
    options.always_print_primitive_fields = true;
    options.add_whitespace = style == JsonStyle::kIndented;
    std::string text;
    // Fails only for an Any of an unknown type; the contract has none.
    if (!pb::util::MessageToJsonString(message, &text, options).ok()) text.clear();
    return text;
}

Status from_json(std::string_view text, pb::Message& message, UnknownFields unknown, const AdmitJson& admit) {
    const pb::Descriptor& type = *message.GetDescriptor();
    std::string respelled;
    // Times and durations are texts: only protobuf knows its own types.
    if (type.file()->package() != "google.protobuf") {
        const Expected<JsonSize> size = check_json(text, type, unknown);
        if (!size) return size.error();
        if (Status admitted = admit ? admit(*size) : Status(Done{}); !admitted) return admitted;
        if (size->respelled) text = respelled = respell_json(text, type);
    }
    pb::util::JsonParseOptions options;
    options.ignore_unknown_fields = unknown == UnknownFields::kIgnored;
    if (pb::util::JsonStringToMessage({text.data(), text.size()}, &message, options).ok()) return Done{};
    // Its words say nothing to who writes JSON; what they could say, check_json has said already, but of its own types.
    return Error{Cause::kMalformedInput,
                 "not the JSON of a " + type.full_name() + "; accepted is what proto3 JSON writes, times and durations included",
                 ""};
}

}  // namespace vsplit::wire

#include "wire/json.h"

#include <google/protobuf/util/json_util.h>

#include "wire/utf8.h"

namespace vsplit::wire {

std::string to_json(const google::protobuf::Message& message, JsonStyle style) {
    google::protobuf::util::JsonPrintOptions options;
    options.always_print_primitive_fields = true;
    options.add_whitespace = style == JsonStyle::kIndented;
    std::string text;
    // Fails only for an Any of an unknown type; the contract has none.
    if (!google::protobuf::util::MessageToJsonString(message, &text, options).ok()) text.clear();
    return text;
}

Status from_json(std::string_view text, google::protobuf::Message& message, UnknownFields unknown) {
    google::protobuf::util::JsonParseOptions options;
    options.ignore_unknown_fields = unknown == UnknownFields::kIgnored;
    const auto parsed = google::protobuf::util::JsonStringToMessage({text.data(), text.size()}, &message, options);
    if (parsed.ok()) return Done{};
    const std::string said(parsed.message().data(), parsed.message().size());
    return Error{Cause::kMalformedInput,
                 "not the JSON of a " + message.GetDescriptor()->full_name() + ": " + valid_utf8(said, 500), ""};
}

}  // namespace vsplit::wire

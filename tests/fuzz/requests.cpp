// Requests as JSON and as bytes: options that can be obeyed, or an error that names the field, whatever comes. The first byte
// says which message and which form.

#include <cstddef>
#include <cstdint>
#include <string>

#include "check.h"
#include "vsplit/method/method_options.h"
#include "vsplit/v1/meshing.pb.h"
#include "wire/convert.h"
#include "wire/features.h"
#include "wire/json.h"

namespace {

using namespace vsplit;

template <class Request>
bool parse(const std::string& text, bool json, Request& request) {
    if (!json) return request.ParseFromString(text);
    const Status parsed = wire::from_json(text, request);
    if (!parsed) fuzz::check(!parsed.error().message.empty(), "an error says what is wrong");
    return parsed.has_value();
}

template <class Request>
void try_method(const std::string& text, bool json) {
    Request request;
    if (!parse(text, json, request)) return;
    const auto options = wire::from_proto(request.options());
    if (!options) return fuzz::check(!options.error().field.empty(), "an error names the field");
    const Status valid = check_options(*options);
    if (!valid) return fuzz::check(!valid.error().field.empty(), "an error names the field");
    const auto again = wire::from_proto(wire::to_proto(*options));
    fuzz::check(again && *again == *options, "options go to the wire and come back");
    const Expected<EncodingChoice> choice = wire::encoding_of(request);
    if (!choice) fuzz::check(!choice.error().field.empty(), "an error names the field");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) return 0;
    const std::string text(reinterpret_cast<const char*>(data) + 1, size - 1);
    const bool json = (data[0] & 1U) != 0;
    switch (data[0] / 2 % 3) {
        case 0:
            try_method<v1::ImproveRequest>(text, json);
            break;
        case 1:
            try_method<v1::ControlRequest>(text, json);
            break;
        default: {
            v1::RemoveFeaturesRequest request;
            if (parse(text, json, request)) [[maybe_unused]]
                const auto removal = wire::from_proto(request);
        }
    }
    return 0;
}

// Configuration files: options or an error, whatever the bytes.

#include <cstddef>
#include <cstdint>
#include <sstream>
#include <string>

#include "check.h"
#include "ops/server_options.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    std::istringstream text(std::string(reinterpret_cast<const char*>(data), size));
    const auto options = vsplit::ops::parse_config(text);
    if (!options) vsplit::fuzz::check(!options.error().message.empty(), "an error says what is wrong");
    if (options) vsplit::fuzz::check(options->service.limits.sessions > 0 && options->max_rpcs > 0, "limits are in their ranges");
    return 0;
}

// What the REST door reads in text: the first line names a path template, the second a target, the third a header field's value.
#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "check.h"
#include "rest/accept.h"
#include "rest/byte_range.h"
#include "rest/conditions.h"
#include "rest/cors.h"
#include "rest/path_template.h"
#include "rest/percent.h"
#include "rest/target.h"

namespace {

std::string_view take_line(std::string_view& text) {
    const std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(text.size(), line.size() + 1));
    return line;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace vsplit::rest;
    using vsplit::fuzz::check;
    std::string_view text(reinterpret_cast<const char*>(data), size);
    const std::string_view pattern = take_line(text);
    const std::string_view asked = take_line(text);
    const auto target = parse_target(asked);
    if (target) check(!target->path.empty() && target->path.front() == '/', "a path begins with a slash");
    const auto path_template = PathTemplate::parse(pattern);
    if (path_template && target) {
        const auto variables = path_template->match(target->path);
        if (variables) check(variables->size() == path_template->fields().size(), "every variable has a value");
    }
    constexpr std::uint64_t kSize = 1000;
    const ByteRange range = parse_range(text, kSize);
    if (range.kind == ByteRange::Kind::kPart) check(range.first <= range.last && range.last < kSize, "a part is in the file");
    constexpr std::array<std::string_view, 2> offers{"application/json", "application/x-ndjson"};
    const auto chosen = choose_media_type(text, offers);
    if (chosen) check(*chosen < offers.size(), "what is chosen is offered");
    static_cast<void>(accepts_encoding(text, "gzip"));
    check(judge("", text, "\"a\"") != Condition::kFailed && judge(text, "", "\"a\"") != Condition::kNotModified,
          "a condition is judged for what it asks");
    static_cast<void>(check_origin(text, asked, {}));
    const auto decoded = percent_decode(text);
    if (decoded) check(decoded->size() <= text.size(), "decoding does not lengthen");
    return 0;
}

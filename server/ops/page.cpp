#include "ops/page.h"

#include <string>
#include <string_view>

#include "ops/page_bytes.h"

namespace vsplit::ops {
namespace {

/// Scripts, styles and data of this server alone: no other one, nothing inline, in no frame.
constexpr const char* kPolicy =
    "default-src 'none'; script-src 'self'; worker-src 'self'; style-src 'self'; img-src 'self'; connect-src 'self'; "
    "base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

rest::Page file(const char* type, std::string_view bytes) {
    return {type,
            [bytes] { return std::string(bytes); },
            {{"Content-Security-Policy", kPolicy},
             {"X-Content-Type-Options", "nosniff"},
             {"Referrer-Policy", "no-referrer"},
             {"Cross-Origin-Opener-Policy", "same-origin"},
             {"Cache-Control", "no-cache"}}};
}

}  // namespace

rest::Pages page_files() {
    constexpr const char* kScript = "text/javascript; charset=utf-8";
    constexpr const char* kBytes = "application/octet-stream";
    return {{"/", file("text/html; charset=utf-8", page_html())}, {"/page.js", file(kScript, page_script())},
            {"/worker.js", file(kScript, page_worker())},         {"/page.css", file("text/css; charset=utf-8", page_style())},
            {"/icon.svg", file("image/svg+xml", page_icon())},    {"/samples/bracket.stl", file(kBytes, sample_bracket())},
            {"/samples/scan.ply", file(kBytes, sample_scan())}};
}

}  // namespace vsplit::ops

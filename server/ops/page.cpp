#include "ops/page.h"

#include <algorithm>
#include <string>
#include <string_view>

#include "ops/page_bytes.h"

namespace vsplit::ops {
namespace {

/// Scripts, styles and data of this server alone: no other one, nothing inline, in no frame. The decoder of records comes in a
/// script as WebAssembly; no text becomes one.
constexpr const char* kPolicy =
    "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; worker-src 'self'; style-src 'self'; img-src 'self'; "
    "connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

// A name with the hash of what it names never means anything else; the others are asked for anew, and mostly not sent again.
constexpr const char* kForGood = "public, max-age=31536000, immutable";
constexpr const char* kAskAgain = "no-cache";
constexpr std::string_view kHashedFolder = "assets/";

constexpr std::string_view kIndex = "index.html";
constexpr const char* kBytes = "application/octet-stream";

const char* type_of(std::string_view path) {
    const std::string_view extension = path.substr(std::min(path.rfind('.'), path.size()));
    if (extension == ".html") return "text/html; charset=utf-8";
    if (extension == ".js") return "text/javascript; charset=utf-8";
    if (extension == ".css") return "text/css; charset=utf-8";
    if (extension == ".svg") return "image/svg+xml";
    return kBytes;
}

rest::Page file(const char* type, std::string_view bytes, const char* cache_control) {
    return rest::unchanging({type,
                             [bytes] { return std::string(bytes); },
                             {{"Content-Security-Policy", kPolicy},
                              {"X-Content-Type-Options", "nosniff"},
                              {"Referrer-Policy", "no-referrer"},
                              {"Cross-Origin-Opener-Policy", "same-origin"}},
                             cache_control});
}

}  // namespace

rest::Pages page_files() {
    rest::Pages pages{{"/samples/bracket.stl", file(kBytes, sample_bracket(), kAskAgain)},
                      {"/samples/scan.ply", file(kBytes, sample_scan(), kAskAgain)}};
    for (const EmbeddedFile& each : built_page()) {
        const std::string path = each.path == kIndex ? "/" : '/' + std::string(each.path);
        const bool hashed = each.path.substr(0, kHashedFolder.size()) == kHashedFolder;
        pages[path] = file(type_of(each.path), each.bytes, hashed ? kForGood : kAskAgain);
    }
    return pages;
}

}  // namespace vsplit::ops

#include "rest/pages.h"

#include <utility>

#include "guard/digest.h"

namespace vsplit::rest {
namespace {

constexpr const char* kWelcome =
    "vsplit: triangle meshes fit for analysis, at any resolution.\n"
    "\n"
    "The API is under /v1, described by /openapi.json. A first step:\n"
    "  curl -T part.stl -X POST http://HOST:PORT/v1/sessions\n"
    "Beside it: /healthz, /readyz, /metrics.\n";

}  // namespace

Page unchanging(Page page) {
    page.digest = guard::hex_digits(guard::digest_of(page.text()));
    return page;
}

Pages operations_pages(const Operations& operations) {
    constexpr const char* kAskAgain = "no-cache";
    Pages pages;
    pages["/"] = unchanging({"text/plain; charset=utf-8", [] { return std::string(kWelcome); }, {}, kAskAgain});
    pages["/healthz"] = {"application/json", [] { return std::string("{\"status\":\"SERVING\"}\n"); }};
    pages["/openapi.json"] =
        unchanging({"application/json", [document = operations.openapi] { return document; }, {}, kAskAgain});
    if (operations.metrics) {
        pages["/metrics"] = {"text/plain; version=0.0.4; charset=utf-8", operations.metrics};
        pages["/metrics"].guarded = true;
    }
    return pages;
}

}  // namespace vsplit::rest

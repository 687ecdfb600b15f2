#include "rest/pages.h"

namespace vsplit::rest {
namespace {

constexpr const char* kWelcome =
    "vsplit: triangle meshes fit for analysis, at any resolution.\n"
    "\n"
    "The API is under /v1, described by /openapi.json. A first step:\n"
    "  curl -T part.stl -X POST http://HOST:PORT/v1/sessions\n"
    "Beside it: /healthz, /readyz, /metrics.\n";

}  // namespace

Pages operations_pages(const Operations& operations) {
    const HeaderFields fresh{{"Cache-Control", "no-store"}};
    Pages pages;
    pages["/"] = {"text/plain; charset=utf-8", [] { return std::string(kWelcome); }};
    pages["/healthz"] = {"application/json", [] { return std::string("{\"status\":\"SERVING\"}\n"); }, fresh};
    pages["/openapi.json"] = {"application/json", [document = operations.openapi] { return document; }};
    if (operations.metrics) pages["/metrics"] = {"text/plain; version=0.0.4; charset=utf-8", operations.metrics, fresh, true};
    return pages;
}

}  // namespace vsplit::rest

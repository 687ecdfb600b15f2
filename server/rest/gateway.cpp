#include "rest/gateway.h"

#include <algorithm>
#include <utility>

#include "rest/accept.h"
#include "rest/conditions.h"
#include "rest/cors.h"
#include "rest/freshness.h"
#include "rest/message_shape.h"
#include "rest/openapi.h"
#include "wire/utf8.h"

namespace vsplit::rest {
namespace {

constexpr unsigned kHeavyThreads = 2;
// Files that begin at a time: enough that no core waits, and so few that what is done for them keeps no other request.
constexpr std::size_t kFilesAtATime = 4;
constexpr std::chrono::milliseconds kLongestTurn{10};
constexpr std::size_t kQuotedBytes = 200;
constexpr std::size_t kLongPage = 1400;  // worth compressing
constexpr std::string_view kPageMethods = "GET, HEAD, OPTIONS";

/// A shell's variable that was never set leaves such a path.
const char* hint_at(const std::string& path) {
    const bool nameless = path.find("//") != std::string::npos || path.find("/:") != std::string::npos;
    return nameless ? "; a name in the path is empty" : "";
}

Problem no_such_path(const std::string& path) {
    return http_problem(
        404, Cause::kNotFound,
        "nothing is at " + wire::valid_utf8(path, kQuotedBytes) + "; /openapi.json describes what there is" + hint_at(path));
}

Problem wrong_method(const Exchange& exchange, const std::string& path, std::string allowed) {
    Problem problem = http_problem(
        405, Cause::kUnsupported,
        "the path has no " + wire::valid_utf8(exchange.method(), kQuotedBytes) + "; it has " + allowed + hint_at(path));
    problem.allow = std::move(allowed);
    return problem;
}

// gRPC ends the program where metadata is anything else.
bool is_metadata(std::string_view text) {
    return std::all_of(text.begin(), text.end(), [](char c) { return c >= ' ' && c <= '~'; });
}

bool is_get(const Exchange& exchange) { return exchange.method() == "GET" || exchange.method() == "HEAD"; }

const Route* find_route(const std::vector<const Route*>& routes, std::string_view method) {
    for (const Route* route : routes) {
        if (route->method == method || (method == "HEAD" && route->method == "GET")) return route;
    }
    return nullptr;
}

}  // namespace

std::function<Status(const Exchange&)> admission_of(guard::Gatekeeper& gate) {
    return [&gate](const Exchange& exchange) -> Status {
        const Expected<std::string> owner =
            gate.admit({exchange.header(http::field::authorization), exchange.mark().peer}, guard::Access::kRead);
        return owner ? Status(Done{}) : Status(owner.error());
    };
}

std::function<Status(const Exchange&)> pace_of(guard::Gatekeeper& gate) {
    return [admit = admission_of(gate)](const Exchange& exchange) -> Status {
        Status admitted = admit(exchange);
        if (!admitted && admitted.error().cause == Cause::kLimitExceeded) return admitted;
        return Done{};
    };
}

Gateway::Gateway(Backend backend, RestOptions options, std::unique_ptr<Schema> schema, Router router)
    : backend_(std::move(backend)),
      options_(std::move(options)),
      schema_(std::move(schema)),
      router_(std::move(router)),
      budget_(options_.limits.all_json_bytes),
      background_(kHeavyThreads),
      files_(kFilesAtATime, kLongestTurn),
      rpcs_(backend_.channel) {
    pages_ = operations_pages({backend_.ready, backend_.metrics, openapi_document(*schema_, router_, backend_.version)});
    for (auto& [path, page] : backend_.pages) pages_[path] = page;
}

Gateway::~Gateway() = default;

Expected<std::unique_ptr<Gateway>> Gateway::make(Backend backend, RestOptions options) {
    Expected<std::unique_ptr<Schema>> schema = Schema::make(backend.descriptor_sets, backend.services);
    if (!schema) return schema.error();
    Expected<Router> router = Router::make(**schema);
    if (!router) return router.error();
    return std::unique_ptr<Gateway>(new Gateway(std::move(backend), std::move(options), *std::move(schema), *std::move(router)));
}

ResponseManner Gateway::manner_of(const http::request<http::buffer_body>& request) {
    const auto field = [&request](http::field name) {
        const auto text = request[name];
        return std::string_view(text.data(), text.size());
    };
    ResponseManner manner;
    manner.version = request.version();
    manner.keep_alive = request.keep_alive();
    manner.head_only = request.method() == http::verb::head;
    manner.background = &background_;
    manner.fields = check_origin(field(http::field::origin), field(http::field::host), options_.cors_origins).fields;
    return manner;
}

// Answers a request that comes too soon, if this is one. Rpcs and guarded pages are counted by the gate that they pass.
Awaitable<bool> Gateway::in_time(Exchange& exchange) const {
    Status paced = Done{};
    if (backend_.pace) paced = backend_.pace(exchange);
    if (paced) co_return true;
    co_await exchange.fail(problem_of(paced.error()));
    co_return false;
}

Awaitable<void> Gateway::refuse(Exchange& exchange, const Problem& problem) {
    const bool in_turn = co_await in_time(exchange);  // g++ 12 makes an illegal instruction of if (co_await a) co_await b;
    if (!in_turn) co_return;
    co_await exchange.fail(problem);
}

Awaitable<void> Gateway::serve(Exchange& exchange) {
    if (!is_metadata(exchange.header(http::field::authorization))) {
        co_return co_await refuse(
            exchange, http_problem(400, Cause::kMalformedInput,
                                   "the header holds more than visible ASCII; accepted is Bearer TOKEN", "Authorization"));
    }
    const std::string_view host = exchange.header(http::field::host);
    if (options_.own_hosts_only && !is_own_host(host, options_.cors_origins)) {
        co_return co_await refuse(exchange,
                                  http_problem(421, Cause::kInvalidOption,
                                               "this server is not known as " + wire::valid_utf8(host, kQuotedBytes) +
                                                   "; accepted are addresses, localhost, and the hosts of vsplitd --cors-origin",
                                               "Host"));
    }
    const std::string_view origin = exchange.header(http::field::origin);
    if (check_origin(origin, host, options_.cors_origins).refused) {
        co_return co_await refuse(exchange, http_problem(403, Cause::kInvalidOption,
                                                         "pages of " + wire::valid_utf8(origin, kQuotedBytes) +
                                                             " may not use this server; vsplitd --cors-origin allows an origin",
                                                         "Origin"));
    }
    if (exchange.target() == "*" && exchange.method() == "OPTIONS") {
        co_return co_await serve_options(exchange, "DELETE, GET, HEAD, OPTIONS, POST, PUT");
    }
    const Expected<Target> target = parse_target(exchange.target());
    if (!target) co_return co_await refuse(exchange, problem_of(target.error()));
    co_await serve_target(exchange, *target);
}

Awaitable<void> Gateway::serve_target(Exchange& exchange, const Target& target) {
    const auto page = pages_.find(target.path);
    const bool ready_page = target.path == kReadyPath;
    if (page != pages_.end() || ready_page) {
        if (exchange.method() == "OPTIONS") co_return co_await serve_options(exchange, std::string(kPageMethods));
        if (!is_get(exchange))
            co_return co_await refuse(exchange, wrong_method(exchange, target.path, std::string(kPageMethods)));
        if (ready_page) co_return co_await serve_ready(exchange);
        const bool guarded = page->second.guarded && backend_.admit != nullptr;
        const Status admitted = guarded ? backend_.admit(exchange) : Status(Done{});
        if (!admitted) co_return co_await exchange.fail(problem_of(admitted.error()));
        const bool free = guarded || target.path == kHealthPath;
        if (!free) {
            if (!co_await in_time(exchange)) co_return;
        }
        co_return co_await serve_page(exchange, page->second);
    }
    const std::vector<const Route*> routes = router_.match(target.path);
    if (routes.empty()) co_return co_await refuse(exchange, no_such_path(target.path));
    if (exchange.method() == "OPTIONS") co_return co_await serve_options(exchange, allowed_methods(routes));
    const Route* const route = find_route(routes, exchange.method());
    if (route == nullptr) co_return co_await refuse(exchange, wrong_method(exchange, target.path, allowed_methods(routes)));
    co_await serve_rpc(exchange, *route, target);
}

Awaitable<void> Gateway::serve_options(Exchange& exchange, const std::string& allowed) {
    if (!co_await in_time(exchange)) co_return;
    ResponseHead head;
    head.status = 204;
    head.fields.emplace_back("Allow", allowed);
    if (!exchange.header(http::field::access_control_request_method).empty()) {
        for (auto& field : preflight_fields(allowed)) head.fields.push_back(std::move(field));
    }
    if (!exchange.body().at_end()) exchange.response().close_after();
    co_await exchange.response().respond(head, {});
}

Awaitable<void> Gateway::serve_page(Exchange& exchange, const Page& page) {
    const std::string text = page.text();
    const bool gzip = text.size() > kLongPage && accepts_encoding(exchange.list(http::field::accept_encoding), "gzip");
    const Freshness freshness{page.digest.empty() ? "" : entity_tag(page.digest, gzip ? "gzip" : ""), page.cache_control,
                              "Accept-Encoding"};
    if (co_await answer_condition(exchange, freshness)) co_return;
    ResponseHead head;
    head.content_type = page.content_type;
    head.fields = fields_of(freshness);
    head.fields.insert(head.fields.end(), page.fields.begin(), page.fields.end());
    head.gzip = gzip;
    if (!exchange.body().at_end()) exchange.response().close_after();
    co_await exchange.response().respond(head, text);
}

Awaitable<void> Gateway::serve_ready(Exchange& exchange) {
    if (backend_.ready && !backend_.ready()) {
        const Error error{Cause::kUnavailable, "the server is shutting down", ""};
        co_return co_await exchange.fail(problem_of(error));
    }
    co_await serve_page(exchange, pages_.find(kHealthPath)->second);
}

Awaitable<void> Gateway::serve_rpc(Exchange& exchange, const Route& route, const Target& target) {
    const Tools tools{rpcs_, {*schema_, background_, budget_}, files_};
    if (creates_with_mesh(exchange, route)) co_return co_await serve_create_with_mesh(exchange, route, target, tools);
    switch (shape_of(*route.rpc)) {
        case RpcShape::kUnary:
            co_return co_await serve_unary(exchange, route, target, tools);
        case RpcShape::kEvents:
            co_return co_await serve_events(exchange, route, target, tools);
        case RpcShape::kFile:
            co_return co_await serve_file(exchange, route, target, tools);
        case RpcShape::kUpload:
            co_return co_await serve_upload(exchange, route, target, tools);
        case RpcShape::kNone:
            break;
    }
    const Error error{Cause::kUnsupported, route.rpc->full_name() + " is for gRPC only", ""};
    co_await exchange.fail(problem_of(error));
}

}  // namespace vsplit::rest

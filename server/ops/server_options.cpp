#include "ops/server_options.h"

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdint>
#include <iostream>
#include <map>
#include <string_view>

namespace vsplit::ops {
namespace {

// Further ahead than this the clock's arithmetic would overflow; it is a century.
constexpr std::int64_t kLongestTtl = std::int64_t{100} * 366 * 24 * 3600;

constexpr unsigned kMostThreads = 1024;

const std::map<std::string, spdlog::level::level_enum> kLevels{{"debug", spdlog::level::debug},
                                                               {"info", spdlog::level::info},
                                                               {"warning", spdlog::level::warn},
                                                               {"error", spdlog::level::err},
                                                               {"off", spdlog::level::off}};

bool takes_free_port(std::string_view listen) { return listen.size() > 2 && listen.substr(listen.size() - 2) == ":0"; }

void add_limits(CLI::App& app, service::Limits& limits) {
    app.add_option("--max-upload-bytes", limits.upload_bytes, "Bytes of an uploaded file")->check(CLI::PositiveNumber);
    app.add_option("--max-faces", limits.faces, "Faces of an uploaded mesh")->check(CLI::PositiveNumber);
    app.add_option("--max-faces-subdivided", limits.faces_subdivided, "Faces of a mesh after subdivision")
        ->check(CLI::PositiveNumber);
    app.add_option("--max-sessions", limits.sessions, "Sessions at a time")->check(CLI::PositiveNumber);
    app.add_option("--max-representations", limits.representations, "Representations of a session")->check(CLI::PositiveNumber);
    app.add_option("--max-waiting", limits.waiting_jobs, "Requests that wait in a session while one runs");
}

}  // namespace

std::variant<ServerOptions, int> parse_server_options(int argc, const char* const* argv) {
    ServerOptions options;
    std::int64_t ttl = std::chrono::duration_cast<std::chrono::seconds>(options.service.session_ttl).count();
    CLI::App app("vsplitd: serves vsplit.v1.Meshing over gRPC, with health and reflection, and over HTTP with JSON", "vsplitd");
    app.option_defaults()->always_capture_default();
    app.set_version_flag("--version", "vsplitd " VSPLIT_VERSION);
    app.add_option("--listen", options.listen, "HOST:PORT to serve gRPC at; port 0 takes a free one");
    const CLI::Option* const http =
        app.add_option("--http", options.http, "HOST:PORT to serve REST at, or off; a free port where --listen takes one");
    app.add_option("--cors-origin", options.rest.cors_origins,
                   "Origin of web pages that may use REST, e.g. https://example.org, or *; several are allowed. Default: none")
        ->option_text("ORIGIN ...");
    app.add_flag("--print-openapi", options.print_openapi, "Print the OpenAPI document and end");
    app.add_option("--workers", options.service.workers, "Methods that run at a time; 0: one a core")
        ->check(CLI::Range(0U, kMostThreads));
    app.add_option("--threads", options.service.threads, "Threads of one method; 0: all cores")
        ->check(CLI::Range(0U, kMostThreads));
    app.add_option("--session-ttl", ttl, "Seconds that an unused session lives")->check(CLI::Range(std::int64_t{1}, kLongestTtl));
    app.add_option("--log-level", options.log_level, "What is logged to stderr")
        ->transform(CLI::CheckedTransformer(kLevels).description(""))
        ->option_text("LEVEL=info: debug, info, warning, error or off");
    add_limits(app, options.service.limits);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error, std::cout, std::cerr) == 0 ? 0 : 1;
    }
    options.service.session_ttl = std::chrono::seconds(ttl);
    // Who asks for a free port wants to be in nobody's way.
    if (http->empty() && takes_free_port(options.listen)) options.http = "127.0.0.1:0";
    return options;
}

}  // namespace vsplit::ops

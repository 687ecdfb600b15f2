#pragma once

#include <spdlog/common.h>

#include <string>
#include <variant>

#include "rest/rest_options.h"
#include "service/limits.h"

namespace vsplit::ops {

/// What vsplitd was asked for on its command line.
struct ServerOptions {
    std::string listen = "127.0.0.1:50051";  ///< gRPC, host:port; port 0 takes a free one
    std::string http = "127.0.0.1:8080";     ///< REST, as `listen`; "off" for none
    rest::RestOptions rest;
    bool print_openapi = false;
    service::ServiceOptions service;
    spdlog::level::level_enum log_level = spdlog::level::info;
};

/// Or the status to exit with: 0 after --help and --version, 1 after an error; what to say has been said.
[[nodiscard]] std::variant<ServerOptions, int> parse_server_options(int argc, const char* const* argv);

}  // namespace vsplit::ops

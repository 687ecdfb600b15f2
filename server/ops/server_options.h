#pragma once

#include <cstdint>
#include <functional>
#include <istream>
#include <optional>
#include <string>
#include <variant>

#include "guard/tls_files.h"
#include "rest/rest_options.h"
#include "service/limits.h"
#include "vsplit/base/expected.h"

namespace vsplit::ops {

/// What vsplitd was asked for by its command line, its environment and its configuration file.
struct ServerOptions {
    std::string listen = "127.0.0.1:50051";  ///< gRPC, host:port; port 0 takes a free one
    std::string http = "127.0.0.1:8080";     ///< REST, as `listen`; "off" for none
    rest::RestOptions rest;
    bool print_openapi = false;
    bool check = false;  ///< asks the server at `listen` whether it serves, and ends
    service::ServiceOptions service;
    std::string data_dir;              ///< where sessions outlive the server; empty: they do not
    std::uint64_t max_disk_bytes = 0;  ///< of meshes and representations in it; 0: no limit
    std::string log_level = "info";    ///< debug, info, warning, error, off
    std::string log_format = "text";   ///< text, json
    double slow_job = 60;              ///< seconds; a method that takes longer is in the log as a warning; 0: none
    guard::TlsFiles tls;
    std::string token_file;                      ///< empty: calls need no token
    std::string new_token;                       ///< NAME:ACCESS; makes a token and ends
    bool insecure = false;                       ///< serves others than this machine without TLS or tokens
    double max_request_rate = 0;                 ///< of a client, a second; 0: no limit
    std::uint32_t max_rpcs = 10'000;             ///< at a time
    std::uint32_t max_message_bytes = 16 << 20;  ///< of one gRPC message
    std::uint64_t max_message_memory = 0;        ///< of messages on their way in, by gRPC; 0: sixteen of the largest
    std::uint32_t max_streams = 1000;            ///< rpcs of one gRPC connection at a time
    std::uint32_t drain = 5;                     ///< seconds that what runs has after SIGTERM
    std::uint32_t keepalive = 60;          ///< seconds of silence on a gRPC connection before it is asked for a sign of life
    std::uint32_t max_connection_age = 0;  ///< seconds after which a gRPC connection is to be opened anew; 0: never
};

/// A variable of the environment, where there is one.
using Environment = std::function<std::optional<std::string>(const std::string& name)>;

/// The process's own.
[[nodiscard]] std::optional<std::string> process_environment(const std::string& name);

/// Reads the command line; what it leaves out comes from the environment, VSPLITD_NAME for --name (an empty one is none), and
/// what that leaves out from the file of --config. Or the status to exit with: 0 after --help, --version and --print-config, 1
/// after an error; what to say has been said.
[[nodiscard]] std::variant<ServerOptions, int> parse_server_options(int argc, const char* const* argv,
                                                                    const Environment& environment = process_environment);

/// A configuration file's text: TOML, `name = value` for each --name. \return INVALID_OPTION for anything else.
[[nodiscard]] Expected<ServerOptions> parse_config(std::istream& text);

}  // namespace vsplit::ops

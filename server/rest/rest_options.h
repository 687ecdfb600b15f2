#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "service/patience.h"

namespace vsplit::rest {

/// What one client may use up, and what all together may.
struct RestLimits {
    std::size_t connections = 2000;                           ///< at a time; more are answered 503, or closed
    std::size_t requests = 10'000;                            ///< on one connection, then it is closed
    std::uint32_t header_bytes = 16 * 1024;                   ///< first line and header of a request
    std::size_t ahead_bytes = std::size_t{64} * 1024;         ///< of requests that a client sends before it has its answer
    std::uint64_t json_bytes = std::uint64_t{32} << 20;       ///< of one JSON body
    std::uint64_t message_bytes = std::uint64_t{16} << 20;    ///< of a message that is made of a JSON body
    std::uint64_t json_memory = std::uint64_t{128} << 20;     ///< that one JSON body and what is made of it take
    std::uint64_t all_json_bytes = std::uint64_t{256} << 20;  ///< that all of them take at a time
    std::chrono::milliseconds header_time{10'000};            ///< for a whole header, from its first byte
    std::chrono::milliseconds idle_time{60'000};              ///< between two requests
    service::Patience patience{};                             ///< with a body, and with an answer of which nothing is taken
};

struct RestOptions {
    RestLimits limits;
    std::vector<std::string> cors_origins;  ///< pages of these origins may use the server; "*" for all. Default: none but its own
    bool own_hosts_only = false;  ///< refuses a Host that is_own_host does not know; for servers that trust who reaches them
    std::function<void()> on_connection_refused{};  ///< of a connection over the limit
    /// Of a client with which no TLS came about, but those that only looked whether somebody listens.
    std::function<void(const std::string& peer, const std::string& reason)> on_tls_failed{};
    unsigned threads = 2;  ///< that speak to clients; none of them computes
};

}  // namespace vsplit::rest

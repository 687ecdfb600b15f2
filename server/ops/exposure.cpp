#include "ops/exposure.h"

#include <arpa/inet.h>
#include <netdb.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <memory>
#include <string>

namespace vsplit::ops {
namespace {

bool is_loopback_address(const sockaddr& address) {
    constexpr std::uint32_t kLoopbackNet = 127;
    constexpr unsigned kNetShift = 24;
    if (address.sa_family == AF_INET) {
        return ntohl(reinterpret_cast<const sockaddr_in&>(address).sin_addr.s_addr) >> kNetShift == kLoopbackNet;
    }
    return address.sa_family == AF_INET6 && IN6_IS_ADDR_LOOPBACK(&reinterpret_cast<const sockaddr_in6&>(address).sin6_addr);
}

Status check_address(const ServerOptions& options, const char* option, const ListenAddress& address) {
    if (options.insecure || is_loopback(address)) return Done{};
    const bool no_tls = options.tls.cert.empty();
    const bool no_tokens = options.token_file.empty();
    if (!no_tls && !no_tokens) return Done{};
    const std::string missing = no_tls && no_tokens ? "TLS (--tls-cert, --tls-key) and tokens (--token-file)"
                                : no_tls            ? "TLS (--tls-cert, --tls-key)"
                                                    : "tokens (--token-file)";
    return Error{Cause::kInvalidOption,
                 "--" + std::string(option) + ' ' + address.text(address.port) + " is reached from other machines, which takes " +
                     missing + "; accepted without is an address of this machine alone, e.g. 127.0.0.1:" + address.port +
                     ", or --insecure",
                 option};
}

}  // namespace

bool is_loopback(const ListenAddress& address) {
    addrinfo hints{};
    hints.ai_socktype = SOCK_STREAM;
    addrinfo* found = nullptr;
    if (getaddrinfo(address.host.c_str(), address.port.c_str(), &hints, &found) != 0) return false;
    const std::unique_ptr<addrinfo, decltype(&freeaddrinfo)> list(found, &freeaddrinfo);
    for (const addrinfo* at = found; at != nullptr; at = at->ai_next) {
        if (!is_loopback_address(*at->ai_addr)) return false;
    }
    return true;
}

Status check_exposure(const ServerOptions& options, const ListenAddress& listen, const std::optional<ListenAddress>& http) {
    const guard::TlsFiles& tls = options.tls;
    if (tls.cert.empty() != tls.key.empty() || (tls.cert.empty() && !tls.client_ca.empty())) {
        return Error{Cause::kInvalidOption, "TLS takes both --tls-cert and --tls-key; --tls-client-ca comes on top", "tls-cert"};
    }
    if (Status open = check_address(options, "listen", listen); !open) return open;
    return http ? check_address(options, "http", *http) : Status(Done{});
}

}  // namespace vsplit::ops

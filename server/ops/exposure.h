#pragma once

#include <optional>

#include "ops/listen_address.h"
#include "ops/server_options.h"

namespace vsplit::ops {

/// Whether nobody but this machine can reach the address. False for a name that is not known.
[[nodiscard]] bool is_loopback(const ListenAddress& address);

/// Whether the server may listen there: beyond this machine it takes TLS and tokens, or --insecure; and TLS takes a certificate
/// and a key. `http` is empty where there is no such door. \return INVALID_OPTION with what is missing.
[[nodiscard]] Status check_exposure(const ServerOptions& options, const ListenAddress& listen,
                                    const std::optional<ListenAddress>& http);

}  // namespace vsplit::ops

#pragma once

#include "guard/tls_files.h"
#include "ops/listen_address.h"
#include "vsplit/base/expected.h"

namespace vsplit::ops {

/// Whether a server of this machine serves at the address it listens at, by grpc.health.v1; for whoever has no other program to
/// ask with, in a container for example. Takes at most 3 s. Over TLS the server's name is not looked at, and its own certificate
/// is shown; where it takes certificates of clients and not its own, that it does TLS is enough. \return UNAVAILABLE with what it
/// answered.
[[nodiscard]] Status check_server(const ListenAddress& address, const guard::TlsFiles& tls);

}  // namespace vsplit::ops

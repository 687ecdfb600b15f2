#pragma once

#include <grpcpp/security/server_credentials.h>

#include <memory>

#include "guard/tls_files.h"

namespace vsplit::rpc {

/// TLS with these files, which are read again when they change, at most once a second; plain where none are named. gRPC keeps to
/// itself what is wrong with a file: look at it first.
[[nodiscard]] std::shared_ptr<grpc::ServerCredentials> credentials_of(const guard::TlsFiles& files);

}  // namespace vsplit::rpc

#pragma once

#include <grpcpp/security/server_credentials.h>

#include <memory>

#include "grpc/stranger_check.h"
#include "guard/tls_book.h"

namespace vsplit::rpc {

/// How connections to the gRPC door come about: with TLS as `tls` has it at the time, plain where that is null; and `check` looks
/// at the header of every call, where it is not null. Both must outlive the server.
[[nodiscard]] std::shared_ptr<grpc::ServerCredentials> door_credentials(std::shared_ptr<guard::TlsBook> tls,
                                                                        StrangerCheck* check);

}  // namespace vsplit::rpc

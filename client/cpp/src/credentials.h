#pragma once

#include <grpcpp/security/credentials.h>
#include <grpcpp/support/client_interceptor.h>

#include <memory>
#include <vector>

#include "vsplit/base/expected.h"
#include "vsplit/client/call_options.h"

namespace vsplit::client {

/// Plain, or TLS where the options name authorities. \return FILE_ACCESS, NOT_FOUND for a file; INVALID_OPTION for a certificate
/// without a key or authorities.
[[nodiscard]] Expected<std::shared_ptr<grpc::ChannelCredentials>> channel_credentials(const ConnectOptions& options);

using InterceptorFactories = std::vector<std::unique_ptr<grpc::experimental::ClientInterceptorFactoryInterface>>;

/// What puts the token and the trace on every call.
[[nodiscard]] InterceptorFactories call_marks(const ConnectOptions& options);

}  // namespace vsplit::client

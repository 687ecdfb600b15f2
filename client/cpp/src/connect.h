#pragma once

#include <grpcpp/channel.h>

#include <memory>
#include <string>

#include "vsplit/base/expected.h"
#include "vsplit/client/call_options.h"

namespace vsplit::client {

/// A channel that is connected. Returns as MeshingClient::connect does.
[[nodiscard]] Expected<std::shared_ptr<grpc::Channel>> open_channel(const std::string& target, const ConnectOptions& options);

}  // namespace vsplit::client

#pragma once

#include <filesystem>
#include <string>

#include "vsplit/base/expected.h"
#include "vsplit/client/call_options.h"
#include "vsplit/v1/meshing.grpc.pb.h"

namespace vsplit::client {

/// As MeshingClient::download_mesh; `server` is for messages.
[[nodiscard]] Expected<std::uint32_t> download_file(v1::Meshing::Stub& stub, const std::string& server,
                                                    const v1::DownloadMeshRequest& request, const std::filesystem::path& file,
                                                    const CallOptions& call);

}  // namespace vsplit::client

#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

#include "vsplit/base/expected.h"
#include "vsplit/client/call_options.h"
#include "vsplit/v1/meshing.grpc.pb.h"

namespace vsplit::client {

/// Where an upload goes.
struct UploadTarget {
    v1::Meshing::Stub& stub;
    const std::string& server;  ///< for messages
    const std::string& session;
};

[[nodiscard]] Expected<v1::Session> upload_file(const UploadTarget& target, const std::filesystem::path& file,
                                                const UploadOptions& options, const CallOptions& call);

[[nodiscard]] Expected<v1::Session> upload_bytes(const UploadTarget& target, std::span<const std::byte> bytes,
                                                 const UploadOptions& options, const CallOptions& call);

}  // namespace vsplit::client

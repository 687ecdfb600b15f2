#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <string>

#include "vsplit/base/expected.h"
#include "vsplit/client/call_options.h"
#include "vsplit/v1/meshing.pb.h"

namespace vsplit::client {

/// A connection to a vsplit server.
///
///     auto client = MeshingClient::connect("127.0.0.1:50051");
///     if (!client) return client.error();
///     auto session = client->create_session();
///     auto uploaded = client->upload_mesh(session->id(), "part.stl");
///     v1::ImproveRequest request;
///     request.set_session(session->id());
///     MeshReceiver receiver;
///     auto made = client->improve(request, receiver.handlers());
///
/// All members but the move and the destructor may be called from several threads at once; each call blocks its thread until it
/// is over. Arguments are used during the call only. Errors are those of the server, cause, field and message restored, or
/// UNAVAILABLE, CANCELLED, DEADLINE_EXCEEDED. Calls that are safe to make again are, while the server cannot be reached
/// (CallOptions::retry). A moved-from client may only be destroyed or assigned to.
/// \pre the client outlives the calls made through it.
class MeshingClient {
public:
    /// \param target "HOST:PORT", or "unix:PATH"
    /// \return INVALID_OPTION (field "server") for another form; UNAVAILABLE, with the reason, when nobody answers
    ///         or TLS does not come about; FILE_ACCESS for a file of TLS.
    [[nodiscard]] static Expected<MeshingClient> connect(const std::string& target, const ConnectOptions& options = {});

    MeshingClient(MeshingClient&&) noexcept;
    MeshingClient& operator=(MeshingClient&&) noexcept;
    MeshingClient(const MeshingClient&) = delete;
    MeshingClient& operator=(const MeshingClient&) = delete;
    ~MeshingClient();

    /// An empty session.
    [[nodiscard]] Expected<v1::Session> create_session(const CallOptions& call = {});

    /// Streams a mesh file, of any size, in parts of 256 KiB. \return also NOT_FOUND or FILE_ACCESS for the file.
    [[nodiscard]] Expected<v1::Session> upload_mesh(const std::string& session, const std::filesystem::path& file,
                                                    const UploadOptions& options = {}, const CallOptions& call = {});

    /// The same from memory.
    [[nodiscard]] Expected<v1::Session> upload_mesh(const std::string& session, std::span<const std::byte> bytes,
                                                    const UploadOptions& options = {}, const CallOptions& call = {});

    [[nodiscard]] Expected<v1::Session> get_session(const std::string& session, const CallOptions& call = {});

    /// One page; go on with its next_page_token until that is empty.
    [[nodiscard]] Expected<v1::ListSessionsResponse> list_sessions(const v1::ListSessionsRequest& request = {},
                                                                   const CallOptions& call = {});

    /// Puts off when the session expires.
    [[nodiscard]] Expected<v1::Session> keep_alive(const std::string& session, const CallOptions& call = {});
    /// NOT_FOUND where a try that was not answered has deleted it: it is gone.
    [[nodiscard]] Status delete_session(const std::string& session, const CallOptions& call = {});

    [[nodiscard]] Expected<v1::Representation> improve(const v1::ImproveRequest& request, const EventHandlers& handlers = {},
                                                       const CallOptions& call = {});

    [[nodiscard]] Expected<v1::Representation> control(const v1::ControlRequest& request, const EventHandlers& handlers = {},
                                                       const CallOptions& call = {});

    [[nodiscard]] Expected<v1::Representation> set_resolution(const v1::SetResolutionRequest& request,
                                                              const EventHandlers& handlers = {}, const CallOptions& call = {});

    /// Writes the mesh file beside `file` and renames it when it is whole. \return the faces it has; also FILE_ACCESS, CORRUPT.
    [[nodiscard]] Expected<std::uint32_t> download_mesh(const v1::DownloadMeshRequest& request, const std::filesystem::path& file,
                                                        const CallOptions& call = {});

    [[nodiscard]] Expected<v1::Quality> get_quality(const v1::GetQualityRequest& request, const CallOptions& call = {});

    [[nodiscard]] Expected<v1::ListFeaturesResponse> list_features(const v1::ListFeaturesRequest& request,
                                                                   const CallOptions& call = {});

    [[nodiscard]] Expected<v1::RemoveFeaturesResponse> remove_features(const v1::RemoveFeaturesRequest& request,
                                                                       const CallOptions& call = {});

private:
    struct Impl;
    explicit MeshingClient(std::unique_ptr<Impl> impl);

    std::unique_ptr<Impl> impl_;
};

}  // namespace vsplit::client

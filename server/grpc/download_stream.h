#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "grpc/mailbox.h"
#include "grpc/message_source.h"
#include "service/meshing_service.h"
#include "service/temp_file.h"
#include "vsplit/v1/meshing.pb.h"

namespace vsplit::rpc {

/// DownloadMesh: an errand writes the file, unnamed and on disk, so that a slow reader costs one chunk of memory and not a file.
/// A full disk keeps nobody from reading: the file is in memory then.
class DownloadSource final : public MessageSource<v1::MeshChunk> {
public:
    static constexpr std::size_t kChunkBytes = std::size_t{256} * 1024;

    struct File {
        service::MeshRef mesh;  ///< as written
        std::optional<service::FileMapping> mapping;
        std::string text;    ///< instead, where there is no disk to write to
        std::string digest;  ///< SHA-256
        std::uint32_t nodes_on_chord = 0;

        [[nodiscard]] std::span<const std::byte> bytes() const {
            return mapping ? mapping->bytes() : std::as_bytes(std::span(text));
        }
    };

    /// \return NOT_FOUND, NOT_READY, INVALID_OPTION (also unit), UNSUPPORTED (order), UNAVAILABLE.
    [[nodiscard]] static Expected<std::unique_ptr<MessageSource>> make(service::MeshingService& service,
                                                                       const service::Caller& caller,
                                                                       const v1::DownloadMeshRequest& request, const Wake& wake);

    [[nodiscard]] Step next(v1::MeshChunk& chunk, grpc::Status& end) override;

private:
    using Prepared = Mailbox<Expected<File>>;

    DownloadSource(MeshFormat format, std::shared_ptr<Prepared> prepared);

    void fill(v1::MeshChunk& chunk);

    const MeshFormat format_;
    const std::shared_ptr<Prepared> prepared_;
    std::optional<File> file_;
    std::size_t sent_ = 0;
};

}  // namespace vsplit::rpc

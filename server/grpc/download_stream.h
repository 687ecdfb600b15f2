#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "grpc/file_shelf.h"
#include "grpc/message_source.h"
#include "service/meshing_service.h"
#include "service/temp_file.h"
#include "vsplit/v1/meshing.pb.h"

namespace vsplit::rpc {

/// DownloadMesh: an errand writes the file, for all who ask for the same; it is not begun when all of them are gone.
class DownloadSource final : public MessageSource<v1::MeshChunk> {
public:
    static constexpr std::size_t kChunkBytes = std::size_t{64} * 1024;

    /// The file, or only what is known of it without making it: then a message without bytes, whose size is 0 where it is not
    /// known.
    enum class Want { kFile, kDescription };

    /// \return NOT_FOUND, NOT_READY, INVALID_OPTION (also unit), UNSUPPORTED (order), UNAVAILABLE.
    [[nodiscard]] static Expected<std::unique_ptr<MessageSource>> make(service::MeshingService& service,
                                                                       const std::shared_ptr<FileShelf>& shelf,
                                                                       const service::Caller& caller,
                                                                       const v1::DownloadMeshRequest& request, Want want,
                                                                       const Wake& wake);

    [[nodiscard]] Step next(v1::MeshChunk& chunk, grpc::Status& end) override;

private:
    DownloadSource(MeshFormat format, std::shared_ptr<SharedFile> file) : format_(format), shared_(std::move(file)) {}

    void fill(const MeshFile& file, v1::MeshChunk& chunk);

    const MeshFormat format_;
    const std::shared_ptr<SharedFile> shared_;
    bool begun_ = false;
    std::size_t sent_ = 0;
};

}  // namespace vsplit::rpc

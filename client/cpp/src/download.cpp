#include "download.h"

#include <optional>
#include <utility>

#include "call.h"
#include "part_file.h"

namespace vsplit::client {
namespace {

/// What the first part says of the whole.
struct Announced {
    std::uint64_t size = 0;
    std::uint32_t faces = 0;
};

/// Writes the parts as they come. A part out of place or a file that takes no more ends it with an error.
Status take_parts(grpc::ClientReader<v1::MeshChunk>& reader, PartFile& file, std::optional<Announced>& announced) {
    v1::MeshChunk part;
    while (reader.Read(&part)) {
        if (!announced) announced = Announced{part.size(), part.faces()};
        if (part.offset() != file.size()) {
            return Error{Cause::kOutOfOrder,
                         "a part of the file begins at byte " + std::to_string(part.offset()) + ", expected is " +
                             std::to_string(file.size()),
                         ""};
        }
        if (Status written = file.write(part.data()); !written) return written;
    }
    return Done{};
}

}  // namespace

Expected<std::uint32_t> download_file(v1::Meshing::Stub& stub, const std::string& server, const v1::DownloadMeshRequest& request,
                                      const std::filesystem::path& file, const CallOptions& call_options) {
    Expected<PartFile> part = PartFile::create(file);
    if (!part) return part.error();
    Call call(call_options);
    const auto reader = stub.DownloadMesh(call.context(), request);
    std::optional<Announced> announced;
    const Status taken = take_parts(*reader, *part, announced);
    if (!taken) call.cancel();
    const grpc::Status status = reader->Finish();
    if (!taken) return taken.error();
    if (!status.ok()) return call_error(status, server);
    if (!announced || announced->size != part->size()) {
        return Error{Cause::kCorrupt,
                     "the server announced " + std::to_string(announced ? announced->size : 0) + " bytes and sent " +
                         std::to_string(part->size()),
                     ""};
    }
    if (Status committed = part->commit(); !committed) return committed.error();
    return announced->faces;
}

}  // namespace vsplit::client

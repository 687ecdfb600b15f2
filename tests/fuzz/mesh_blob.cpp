// Meshes of the data directory: the mesh that was kept, or CORRUPT, whatever the bytes.

#include "store/mesh_blob.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "check.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace vsplit;
    const store::Bytes bytes = std::as_bytes(std::span(data, size));
    const Expected<TriangleMesh> mesh = store::read_mesh_blob(bytes);
    if (!mesh) {
        fuzz::check(mesh.error().cause == Cause::kCorrupt && !mesh.error().message.empty(), "an error says what is wrong");
        return 0;
    }
    std::string written;
    const store::MeshBlob blob(*mesh);
    for (const store::Bytes part : blob.parts()) written.append(reinterpret_cast<const char*>(part.data()), part.size());
    fuzz::check(written == std::string(reinterpret_cast<const char*>(data), size), "what was read is written as it was");
    return 0;
}

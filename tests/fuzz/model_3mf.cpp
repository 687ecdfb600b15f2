#include <cstdint>
#include <span>
#include <string_view>

#include "check.h"
#include "io/zip_writer.h"
#include "vsplit/io/read_mesh.h"

using namespace vsplit;

/// The XML of a 3MF archive, which no change of the packed bytes would ever reach: the root model, and behind a zero byte another
/// one.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    const std::size_t end = text.find('\0');
    ZipWriter archive;
    archive.begin("3D/3dmodel.model");
    archive.add(text.substr(0, end));
    if (end != std::string_view::npos) {
        archive.begin("3D/other.model");
        archive.add(text.substr(end + 1));
    }
    const std::string bytes = archive.take();
    ReadOptions options;
    options.max_faces = 10'000;
    const Expected<ReadResult> result = read_mesh(std::as_bytes(std::span(bytes)), options);
    if (!result) {
        fuzz::check(!result.error().message.empty(), "an error has a message");
        return 0;
    }
    const TriangleMesh& mesh = result->mesh;
    fuzz::check(result->format == MeshFormat::k3mf && result->unit.has_value(), "3MF says its unit");
    fuzz::check(!mesh.faces.empty() && mesh.faces.size() <= options.max_faces, "faces within the limit");
    for (const Triangle& face : mesh.faces) {
        for (const std::uint32_t vertex : face) fuzz::check(vertex < mesh.vertex_count(), "indices are in range");
    }
    fuzz::check(mesh.regions.empty() || mesh.regions.size() == mesh.faces.size(), "every face has a region, or none has");
    return 0;
}

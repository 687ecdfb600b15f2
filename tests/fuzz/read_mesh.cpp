#include "vsplit/io/read_mesh.h"

#include <array>
#include <cstdint>
#include <span>

#include "check.h"
#include "vsplit/io/write_mesh.h"

namespace {

using namespace vsplit;

// The corpus knows them by their number here.
constexpr std::array kFormats = {MeshFormat::kStlBinary, MeshFormat::kStlAscii, MeshFormat::kObj, MeshFormat::kPlyBinary,
                                 MeshFormat::kPlyAscii,  MeshFormat::kOff,      MeshFormat::kMsh, MeshFormat::kInp,
                                 MeshFormat::kBdf,       MeshFormat::kVtk,      MeshFormat::kVtu, MeshFormat::k3mf};

void check_mesh(const TriangleMesh& mesh) {
    fuzz::check(!mesh.faces.empty(), "a mesh that was read has faces");
    for (const Triangle& face : mesh.faces) {
        for (const std::uint32_t vertex : face) fuzz::check(vertex < mesh.vertex_count(), "indices are in range");
        fuzz::check(face[0] != face[1] && face[1] != face[2] && face[2] != face[0], "faces have three corners");
    }
    fuzz::check(mesh.regions.empty() || mesh.regions.size() == mesh.faces.size(), "every face has a region, or none has");
    for (const Vec3& position : mesh.positions) fuzz::check(position.cwiseAbs().maxCoeff() <= 1e15, "coordinates are in range");
}

/// What was read once and is written without loss reads back as it is.
void check_round_trip(const TriangleMesh& mesh) {
    for (const MeshFormat format : {MeshFormat::kPlyBinary, MeshFormat::kVtu, MeshFormat::k3mf}) {
        const std::string bytes = write_mesh(mesh, format);
        const Expected<ReadResult> again = read_mesh(std::as_bytes(std::span(bytes)), {});
        fuzz::check(again && again->mesh.positions == mesh.positions && again->mesh.faces == mesh.faces,
                    "a mesh that was read can be written and read");
    }
}

}  // namespace

/// The first byte chooses the options, the rest is the file.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) return 0;
    ReadOptions options;
    const unsigned choice = data[0] % 16U;
    if (choice < kFormats.size()) options.format = kFormats[choice];
    options.weld = data[0] >= 128 ? 0.125 : 0;
    options.max_faces = 10'000;
    const Expected<ReadResult> result = read_mesh(std::as_bytes(std::span(data + 1, size - 1)), options);
    if (!result) {
        fuzz::check(!result.error().message.empty(), "an error has a message");
        return 0;
    }
    check_mesh(result->mesh);
    check_round_trip(result->mesh);
    return 0;
}

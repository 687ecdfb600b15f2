#include <algorithm>
#include <cstdint>
#include <span>

#include "check.h"
#include "vsplit/io/read_mesh.h"
#include "vsplit/io/write_mesh.h"
#include "vsplit/mesh/inspect.h"
#include "vsplit/repair/repair_mesh.h"

namespace {

using namespace vsplit;

/// Vertices on a small grid and faces between any of them, with a region each: as dirty as meshes get.
TriangleMesh mesh_of(std::span<const std::uint8_t> bytes) {
    constexpr std::size_t kBytesAFace = 4;
    constexpr unsigned kVertices = 64;
    TriangleMesh mesh;
    for (unsigned v = 0; v < kVertices; ++v) mesh.positions.emplace_back(v % 4, v / 4 % 4, v / 16 * (v % 3 == 0 ? 1.0 : 1.0001));
    for (; bytes.size() >= kBytesAFace && mesh.faces.size() < 400; bytes = bytes.subspan(kBytesAFace)) {
        mesh.faces.push_back({bytes[0] % kVertices, bytes[1] % kVertices, bytes[2] % kVertices});
        mesh.regions.push_back(bytes[3] % 8U);
    }
    mesh.sets = {{"low", {1, 2, 3}}, {"high", {5, 6, 7}}};
    return mesh;
}

bool is_in(const FaceSet& set, std::uint32_t region) {
    return std::find(set.regions.begin(), set.regions.end(), region) != set.regions.end();
}

bool is_in_any(const std::vector<FaceSet>& sets, std::uint32_t region) {
    return std::any_of(sets.begin(), sets.end(), [&](const FaceSet& set) { return is_in(set, region); });
}

void check_repaired(const TriangleMesh& before, const RepairedMesh& repaired) {
    const TriangleMesh& mesh = repaired.mesh;
    fuzz::check(repaired.parent.size() == mesh.faces.size(), "every face has a parent");
    for (const std::uint32_t parent : repaired.parent)
        fuzz::check(parent < before.face_count(), "parents are faces of the input");
    fuzz::check(mesh.regions.size() == mesh.faces.size(), "every face keeps a region");
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
        for (const std::uint32_t v : mesh.faces[f]) fuzz::check(v < mesh.vertex_count(), "indices are in range");
        const std::uint32_t was = before.regions[repaired.parent[f]], is = mesh.regions[f];
        fuzz::check(was == is || is_in_any(mesh.sets, is), "another region than its parent's is one of sets");
        for (std::size_t s = 0; s < before.sets.size(); ++s)
            fuzz::check(!is_in(before.sets[s], was) || is_in(mesh.sets[s], is), "a face is in its parent's sets");
    }
    if (!mesh.faces.empty()) fuzz::check(bool(require_manifold(inspect(mesh))), "a repaired mesh is a manifold");
}

}  // namespace

/// The first byte chooses the mode, the rest is the mesh.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size < 5) return 0;
    const TriangleMesh mesh = mesh_of(std::span(data + 1, size - 1));
    RepairOptions options;
    options.mode = data[0] % 2 == 0 ? RepairMode::kSafe : RepairMode::kFull;
    options.weld = data[0] >= 128 ? 0.01 : 0;
    if (data[0] % 4 == 3) options.hole_size = 10;
    const Expected<RepairedMesh> repaired = repair_mesh(mesh, options);
    fuzz::check(bool(repaired), "a mesh of good indices can be repaired");
    check_repaired(mesh, *repaired);
    return 0;
}

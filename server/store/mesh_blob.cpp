#include "store/mesh_blob.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <string>

namespace vsplit::store {
namespace {

static_assert(std::endian::native == std::endian::little, "the arrays are written as they lie in memory");
static_assert(sizeof(Vec3) == 3 * sizeof(double) && sizeof(Triangle) == 3 * sizeof(std::uint32_t));

constexpr std::uint32_t kMagicLow = 0x4c505356;   // "VSPL"
constexpr std::uint32_t kMagicHigh = 0x4853454d;  // "MESH"
constexpr std::size_t kHeaderBytes = 24;

template <class T>
void copy(Bytes& from, std::vector<T>& to, std::size_t count) {
    to.resize(count);
    if (count != 0) std::memcpy(static_cast<void*>(to.data()), from.data(), count * sizeof(T));
    from = from.subspan(count * sizeof(T));
}

Error corrupt(const std::string& what) { return {Cause::kCorrupt, "a stored mesh: " + what, ""}; }

}  // namespace

MeshBlob::MeshBlob(const TriangleMesh& mesh)
    : header_{kMagicLow, kMagicHigh, mesh.vertex_count(), mesh.face_count(), static_cast<std::uint32_t>(mesh.regions.size()), 0},
      parts_{std::as_bytes(std::span(header_)), std::as_bytes(std::span(mesh.positions)), std::as_bytes(std::span(mesh.faces)),
             std::as_bytes(std::span(mesh.regions))} {}

Expected<TriangleMesh> read_mesh_blob(Bytes bytes) {
    std::array<std::uint32_t, 6> header{};
    if (bytes.size() < kHeaderBytes) return corrupt("no header in " + std::to_string(bytes.size()) + " bytes");
    std::memcpy(header.data(), bytes.data(), kHeaderBytes);
    bytes = bytes.subspan(kHeaderBytes);
    const auto [low, high, vertices, faces, regions, zero] = header;
    if (low != kMagicLow || high != kMagicHigh || zero != 0 || (regions != 0 && regions != faces))
        return corrupt("not its header");
    const std::uint64_t expected = std::uint64_t{24} * vertices + std::uint64_t{12} * faces + std::uint64_t{4} * regions;
    if (bytes.size() != expected) {
        return corrupt(std::to_string(bytes.size()) + " bytes of arrays, expected are " + std::to_string(expected));
    }
    TriangleMesh mesh;
    copy(bytes, mesh.positions, vertices);
    copy(bytes, mesh.faces, faces);
    copy(bytes, mesh.regions, regions);
    const bool known = std::all_of(mesh.faces.begin(), mesh.faces.end(),
                                   [n = vertices](const Triangle& f) { return f[0] < n && f[1] < n && f[2] < n; });
    if (!known) return corrupt("a face has a vertex that is none");
    return mesh;
}

}  // namespace vsplit::store

#include "vsplit/mrr/base_codec.h"

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <utility>

#include "mrr/base_coder.h"
#include "mrr/face_walk.h"

namespace vsplit {
namespace {

constexpr std::size_t kHeaderBytes = 2;  // bits a coordinate; how
constexpr char kWalk = 0, kPlain = 1;

/// What the columns unpack to at most: a vertex three coordinates, a face three numbers, with all their bits.
constexpr std::uint64_t kMostVertexBytes = 24, kMostFaceBytes = 24;

bool goes_as_the_walk(const TriangleMesh& base, std::uint32_t ghosts) {
    const std::vector<HalfEdge> twins = half_edge_twins(base);
    const auto order = walk_faces(
        base.face_count(), [](std::uint32_t) { return true; }, [&twins](HalfEdge h) { return twins[h]; });
    std::uint32_t known = ghosts;
    for (std::uint32_t f = 0; f < base.face_count(); ++f) {
        if (order[f] != 3 * f) return false;
        for (const std::uint32_t vertex : base.faces[f]) {
            if (vertex > known) return false;
            if (vertex == known) ++known;
        }
    }
    return known == base.vertex_count();
}

template <class Codes>
bool write(ColumnWriter& columns, TriangleMesh& mesh, std::uint32_t ghosts, const Codes& codes, bool walk) {
    if (walk) return WalkCoder(SymbolWriter(columns), codes, mesh).code(mesh.vertex_count(), mesh.face_count(), ghosts);
    return code_plain(SymbolWriter(columns), codes, mesh, mesh.vertex_count(), mesh.face_count());
}

template <class Codes>
bool read(ColumnReader& columns, TriangleMesh& mesh, const PackedBase& packed, const Codes& codes, bool walk) {
    if (walk) return WalkCoder(SymbolReader(columns), codes, mesh).code(packed.vertices, packed.faces, packed.ghosts);
    return code_plain(SymbolReader(columns), codes, mesh, packed.vertices, packed.faces);
}

Error corrupt(const std::string& what) { return {Cause::kCorrupt, "packed base mesh: " + what, ""}; }

}  // namespace

std::string pack_base(const TriangleMesh& base, std::uint32_t ghosts, const PositionGrid& grid) {
    assert(grid.encoding() != RecordEncoding::kFloat64);
    const bool walk = goes_as_the_walk(base, ghosts);
    ColumnWriter columns;
    TriangleMesh mesh = base;
    [[maybe_unused]] const bool written = grid.encoding() == RecordEncoding::kFloat32
                                              ? write(columns, mesh, ghosts, Float32Codes(grid), walk)
                                              : write(columns, mesh, ghosts, QuantisedCodes(grid), walk);
    assert(written && mesh == base);
    std::string packed{static_cast<char>(grid.bits()), walk ? kWalk : kPlain};
    columns.pack(packed);
    return packed;
}

Expected<TriangleMesh> unpack_base(const PackedBase& packed, const PositionGrid& grid) {
    if (grid.encoding() == RecordEncoding::kFloat64) return corrupt("its encoding is FLOAT64, which is not packed");
    if (packed.bytes.size() < kHeaderBytes || static_cast<std::uint32_t>(packed.bytes[0]) != grid.bits())
        return corrupt("it is not of " + std::to_string(grid.bits()) + " bits a coordinate, as announced");
    const char how = static_cast<char>(packed.bytes[1]);
    if (how != kWalk && how != kPlain) return corrupt("its layout is unknown");
    ColumnReader columns;
    // No more than half of what there is to address, where that is 32 bits.
    const std::uint64_t most =
        std::min<std::uint64_t>(packed.vertices * kMostVertexBytes + packed.faces * kMostFaceBytes, PTRDIFF_MAX);
    if (Status unpacked = columns.unpack(packed.bytes.subspan(kHeaderBytes), static_cast<std::size_t>(most)); !unpacked)
        return corrupt(unpacked.error().message);
    TriangleMesh mesh;
    const bool made = grid.encoding() == RecordEncoding::kFloat32
                          ? read(columns, mesh, packed, Float32Codes(grid), how == kWalk)
                          : read(columns, mesh, packed, QuantisedCodes(grid), how == kWalk);
    if (made && columns.all_read() && !columns.ran_short()) return mesh;
    return corrupt("it does not make the " + std::to_string(packed.vertices) + " vertices and " + std::to_string(packed.faces) +
                   " faces announced");
}

}  // namespace vsplit

#include <array>
#include <cstdint>
#include <span>
#include <string>

#include "check.h"
#include "vsplit/mrr/base_codec.h"
#include "vsplit/mrr/record_codec.h"

namespace {

using namespace vsplit;

TriangleMesh octahedron() {
    return {{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
            {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}}};
}

/// The lowest bit says which encoding, the others how many ghosts.
PositionGrid grid_of(std::uint8_t choice) {
    if ((choice & 1U) != 0) return PositionGrid::float32();
    return *PositionGrid::quantised(14, Vec3(-1, -1, -1), 0x1p-13);
}

void try_block(std::uint8_t choice, std::uint16_t count, std::string payload) {
    const PositionGrid grid = grid_of(choice);
    Expected<ProgressiveMesh> mesh = ProgressiveMesh::from_base(octahedron(), choice >> 1U & 1U);
    fuzz::check(mesh.has_value(), "the base is a mesh");
    const TriangleMesh base = mesh->mesh();
    RecordCodec codec(grid);
    RecordBlock block{0, count, grid.encoding(), std::move(payload), 0};
    block.crc32c = crc32c(std::as_bytes(std::span(block.payload)));
    RecordList records;
    if (!codec.decode(block, *mesh, &records)) {
        fuzz::check(mesh->mesh() == base && records.empty(), "a refused block changes nothing");
        return;
    }
    fuzz::check(records.size() == count && mesh->records() == count, "a block brings what it says");
    Expected<ProgressiveMesh> again = ProgressiveMesh::from_base(base, mesh->ghosts());
    fuzz::check(static_cast<bool>(again->refine(records)) && again->mesh() == mesh->mesh(), "its records make the same mesh");
    if (count == 0) return;
    Expected<ProgressiveMesh> encoding = ProgressiveMesh::from_base(base, mesh->ghosts());
    const Expected<RecordBlock> encoded = codec.encode(records, 0, records.size(), *encoding);
    fuzz::check(encoded.has_value() && encoding->level() == mesh->level(), "what was decoded can be encoded");
}

void try_base(std::uint8_t choice, std::uint16_t counts, const std::string& packed) {
    const std::uint32_t vertices = counts & 0xFFU, faces = std::uint32_t{counts} >> 8U, ghosts = choice >> 2U & 3U;
    const PackedBase base{std::as_bytes(std::span(packed)), vertices, faces, ghosts};
    const Expected<TriangleMesh> mesh = unpack_base(base, grid_of(choice));
    if (!mesh) {
        fuzz::check(mesh.error().cause == Cause::kCorrupt, "what is no base mesh is corrupt");
        return;
    }
    fuzz::check(mesh->vertex_count() == base.vertices && mesh->face_count() == base.faces, "it has the counts announced");
    static_cast<void>(ProgressiveMesh::from_base(*mesh, base.ghosts));
}

}  // namespace

/// A byte of choices (the highest bit: a base mesh, not a block), two of counts, the payload.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    constexpr std::size_t kHeader = 3;
    if (size < kHeader) return 0;
    const auto counts = static_cast<std::uint16_t>(data[1] | data[2] << 8);
    std::string payload(data + kHeader, data + size);
    if (data[0] >= 128) {
        try_base(data[0], counts, payload);
    } else {
        try_block(data[0], counts, std::move(payload));
    }
    return 0;
}

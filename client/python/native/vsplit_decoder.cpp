#include "vsplit_decoder.h"

#include <algorithm>
#include <new>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "vsplit/mesh/length_unit.h"
#include "vsplit/mrr/base_codec.h"
#include "vsplit/mrr/mrr_file.h"
#include "vsplit/mrr/record_codec.h"

using vsplit::Cause;
using vsplit::Done;
using vsplit::Error;
using vsplit::Expected;
using vsplit::PositionGrid;
using vsplit::RecordEncoding;
using vsplit::Status;
using vsplit::TriangleMesh;
using vsplit::Vec3;

struct vsplit_decoder {
    std::string error;
    vsplit::RecordCodec codec;
    vsplit::MultiresMesh held;
    std::uint32_t first_record = 0;  // the first of held.records; not 0 on a keyframe
    std::optional<vsplit::ProgressiveMesh> mesh;
    TriangleMesh visible;
    std::optional<vsplit::LengthUnit> unit;

    void show_what_is_reached() { visible = vsplit::visible_of(*mesh, held); }

    Status begin(TriangleMesh base, std::uint32_t ghosts, const PositionGrid& grid) {
        Expected<vsplit::ProgressiveMesh> made = vsplit::ProgressiveMesh::from_base(base, ghosts);
        if (!made) return made.error();
        const std::uint32_t ghost_faces = vsplit::count_ghost_faces(base, ghosts);
        held = {std::move(base), {}, ghosts, ghost_faces, {}};
        mesh = *std::move(made);
        codec = vsplit::RecordCodec(grid);
        first_record = 0;
        unit.reset();
        show_what_is_reached();
        return Done{};
    }

    Status load(std::span<const std::byte> bytes) {
        Expected<vsplit::StoredMrr> stored = vsplit::decode_mrr(bytes);
        if (!stored) return stored.error();
        if (Status begun = begin(stored->mrr.base, stored->mrr.ghosts, stored->grid); !begun) return begun;
        held = std::move(stored->mrr);
        unit = stored->unit;
        return show(stored->faces);
    }

    Status go_to(std::size_t records) {
        if (!mesh) return Error{Cause::kOutOfOrder, "no base mesh has come", ""};
        mesh->rewind(records);
        return mesh->refine(held.records.slice(mesh->records(), records - mesh->records()));
    }

    std::uint32_t records_held() const { return first_record + static_cast<std::uint32_t>(held.records.size()); }

    Status append(const vsplit::RecordBlock& block) {
        if (block.first != records_held()) {
            return Error{
                Cause::kOutOfOrder,
                "a block begins at record " + std::to_string(block.first) + ", expected is " + std::to_string(records_held()),
                ""};
        }
        if (Status gone = go_to(held.records.size()); !gone) return gone;
        if (Status decoded = codec.decode(block, *mesh, &held.records); !decoded) return decoded;
        held.border_splits = mesh->border_splits();
        return Done{};
    }

    Status show(std::uint32_t faces) {
        if (Status gone = go_to(held.record_of_level(held.level_for(faces))); !gone) return gone;
        if (Status fits = check_regions(); !fits) return fits;
        show_what_is_reached();
        return Done{};
    }

    /// Without the check the mesh would be shown as one without regions.
    Status check_regions() const {
        const std::size_t faces = mesh->mesh().faces.size();
        if (held.regions.empty() || held.regions.size() >= faces) return Done{};
        return Error{Cause::kCorrupt,
                     "regions of " + std::to_string(held.regions.size()) + " faces came, expected are those of " +
                         std::to_string(faces) + " or more",
                     ""};
    }

    Status set_regions(std::span<const std::uint32_t> ids) {
        if (!mesh) return Error{Cause::kOutOfOrder, "regions came without a base mesh", ""};
        held.regions.assign(ids.begin(), ids.end());
        if (Status fits = check_regions(); !fits) return fits;
        show_what_is_reached();
        return Done{};
    }

    Status add_set(const char* name, std::span<const std::uint32_t> regions) {
        if (!mesh) return Error{Cause::kOutOfOrder, "a set of regions came without a base mesh", ""};
        held.sets.push_back({name, {regions.begin(), regions.end()}});
        return Done{};
    }
};

namespace {

/// No exception leaves the library.
template <class Call>
int guarded(vsplit_decoder* decoder, const Call& call) {
    try {
        const Status done = call();
        if (done) return 0;
        decoder->error = done.error().message;
    } catch (const std::exception& failure) {
        decoder->error = failure.what();
    }
    return 1;
}

Expected<PositionGrid> grid_of(std::uint32_t encoding, std::uint32_t bits, const double* origin, double step) {
    if (RecordEncoding{encoding} == RecordEncoding::kFloat32) return PositionGrid::float32();
    if (RecordEncoding{encoding} == RecordEncoding::kQuantised)
        return PositionGrid::quantised(bits, Vec3(origin[0], origin[1], origin[2]), step);
    return Error{Cause::kCorrupt, "encoding " + std::to_string(encoding) + " has no packed base mesh", ""};
}

}  // namespace

vsplit_decoder* vsplit_decoder_new() { return new (std::nothrow) vsplit_decoder(); }
void vsplit_decoder_free(vsplit_decoder* decoder) { delete decoder; }
const char* vsplit_decoder_error(const vsplit_decoder* decoder) { return decoder->error.c_str(); }

int vsplit_decoder_begin(vsplit_decoder* decoder, const double* positions, std::uint32_t vertices, const std::uint32_t* indices,
                         std::uint32_t faces, std::uint32_t ghosts) {
    return vsplit_decoder_begin_keyframe(decoder, positions, vertices, indices, faces, ghosts, 0);
}

int vsplit_decoder_begin_keyframe(vsplit_decoder* decoder, const double* positions, std::uint32_t vertices,
                                  const std::uint32_t* indices, std::uint32_t faces, std::uint32_t ghosts,
                                  std::uint32_t first_record) {
    return guarded(decoder, [&] {
        TriangleMesh base;
        for (std::size_t v = 0; v < vertices; ++v)
            base.positions.emplace_back(positions[3 * v], positions[3 * v + 1], positions[3 * v + 2]);
        for (std::size_t f = 0; f < faces; ++f) base.faces.push_back({indices[3 * f], indices[3 * f + 1], indices[3 * f + 2]});
        Status begun = decoder->begin(std::move(base), ghosts, PositionGrid());
        if (begun) decoder->first_record = first_record;
        return begun;
    });
}

int vsplit_decoder_begin_packed(vsplit_decoder* decoder, const std::uint8_t* bytes, std::size_t size, std::uint32_t crc32c,
                                std::uint32_t vertices, std::uint32_t faces, std::uint32_t ghosts, std::uint32_t encoding,
                                std::uint32_t bits, const double* origin, double step) {
    return guarded(decoder, [&]() -> Status {
        if (vsplit::crc32c(std::as_bytes(std::span(bytes, size))) != crc32c)
            return vsplit::Error{vsplit::Cause::kCorrupt, "base mesh: its CRC-32C does not fit its bytes", ""};
        const Expected<PositionGrid> grid = grid_of(encoding, bits, origin, step);
        if (!grid) return grid.error();
        Expected<TriangleMesh> base =
            vsplit::unpack_base({std::as_bytes(std::span(bytes, size)), vertices, faces, ghosts}, *grid);
        if (!base) return base.error();
        return decoder->begin(*std::move(base), ghosts, *grid);
    });
}

int vsplit_decoder_load(vsplit_decoder* decoder, const std::uint8_t* bytes, std::size_t size) {
    return guarded(decoder, [&] { return decoder->load(std::as_bytes(std::span(bytes, size))); });
}

int vsplit_decoder_set_regions(vsplit_decoder* decoder, const std::uint32_t* ids, std::uint32_t faces) {
    return guarded(decoder, [&] { return decoder->set_regions({ids, faces}); });
}

int vsplit_decoder_add_set(vsplit_decoder* decoder, const char* name, const std::uint32_t* regions, std::uint32_t count) {
    return guarded(decoder, [&] { return decoder->add_set(name, {regions, count}); });
}

int vsplit_decoder_append(vsplit_decoder* decoder, std::uint32_t first, std::uint32_t count, std::uint32_t encoding,
                          std::uint32_t crc32c, const std::uint8_t* payload, std::size_t size) {
    return guarded(decoder, [&] {
        return decoder->append({first, count, RecordEncoding{encoding}, std::string(payload, payload + size), crc32c});
    });
}

int vsplit_decoder_show(vsplit_decoder* decoder, std::uint32_t faces) {
    return guarded(decoder, [&] { return decoder->show(faces); });
}

std::uint32_t vsplit_decoder_faces_held(const vsplit_decoder* decoder) { return decoder->mesh ? decoder->held.faces_max() : 0; }
std::uint32_t vsplit_decoder_records_held(const vsplit_decoder* decoder) { return decoder->records_held(); }
std::uint32_t vsplit_decoder_vertices(const vsplit_decoder* decoder) { return decoder->visible.vertex_count(); }
std::uint32_t vsplit_decoder_faces(const vsplit_decoder* decoder) { return decoder->visible.face_count(); }

void vsplit_decoder_copy(const vsplit_decoder* decoder, double* positions, std::uint32_t* indices) {
    for (const Vec3& position : decoder->visible.positions)
        positions = std::copy(position.data(), position.data() + 3, positions);
    for (const vsplit::Triangle& face : decoder->visible.faces) indices = std::copy(face.begin(), face.end(), indices);
}

int vsplit_decoder_has_regions(const vsplit_decoder* decoder) { return decoder->held.regions.empty() ? 0 : 1; }

void vsplit_decoder_copy_regions(const vsplit_decoder* decoder, std::uint32_t* ids) {
    std::copy(decoder->visible.regions.begin(), decoder->visible.regions.end(), ids);
}

std::uint32_t vsplit_decoder_sets(const vsplit_decoder* decoder) { return static_cast<std::uint32_t>(decoder->held.sets.size()); }
const char* vsplit_decoder_set_name(const vsplit_decoder* decoder, std::uint32_t set) {
    return decoder->held.sets[set].name.c_str();
}
std::uint32_t vsplit_decoder_set_size(const vsplit_decoder* decoder, std::uint32_t set) {
    return static_cast<std::uint32_t>(decoder->held.sets[set].regions.size());
}
void vsplit_decoder_copy_set(const vsplit_decoder* decoder, std::uint32_t set, std::uint32_t* regions) {
    const std::vector<std::uint32_t>& from = decoder->held.sets[set].regions;
    std::copy(from.begin(), from.end(), regions);
}

const char* vsplit_decoder_unit(const vsplit_decoder* decoder) {
    return decoder->unit ? vsplit::unit_symbol(*decoder->unit).data() : "";  // of literals, so it ends with a 0
}

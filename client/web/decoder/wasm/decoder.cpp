#include "decoder.h"

#include <cstring>
#include <optional>
#include <span>
#include <string>

#include "held_mesh.h"
#include "mesh/corners.h"
#include "vsplit/mrr/base_codec.h"
#include "vsplit/mrr/record_codec.h"

namespace vsplit::web {
namespace {

struct State {
    RecordBlock block;  // its payload is the room for bytes that come in
    PositionGrid grid;
    RecordCodec codec;
    std::optional<TriangleMesh> base;
    std::optional<HeldMesh> held;
    std::string error;
    View view;
};

State& state() {
    static auto* const the_state = new State;  // lives as long as the module
    return *the_state;
}

std::span<const std::byte> incoming() { return std::as_bytes(std::span(state().block.payload)); }

void look_at(const TriangleMesh& mesh) {
    View& view = state().view;
    static_assert(sizeof(Vec3) == 3 * sizeof(double));
    view.positions = mesh.positions.empty() ? nullptr : mesh.positions.front().data();
    view.vertices = mesh.vertex_count();
    view.corners = corners_of(mesh.faces);
    view.faces = mesh.face_count();
}

/// The mesh has changed, or may have.
void look() {
    const HeldMesh& held = *state().held;
    look_at(held.mesh().mesh());
    View& view = state().view;
    view.level = static_cast<std::uint32_t>(held.mesh().level());
    view.records = static_cast<std::uint32_t>(held.mesh().records());
    view.undone = static_cast<std::uint32_t>(held.undone());
}

bool done(const Status& status) {
    if (status) return true;
    State& of = state();
    of.error = status.error().message;
    of.view.error = of.error.data();
    of.view.error_size = static_cast<std::uint32_t>(of.error.size());
    return false;
}

Expected<PositionGrid> grid_of(std::uint32_t encoding, std::uint32_t bits, const Vec3& origin, double step) {
    switch (RecordEncoding{encoding}) {
        case RecordEncoding::kFloat64:
            return PositionGrid();
        case RecordEncoding::kFloat32:
            return PositionGrid::float32();
        case RecordEncoding::kQuantised:
            return PositionGrid::quantised(bits, origin, step);
    }
    return Error{Cause::kCorrupt, "encoding " + std::to_string(encoding) + " is unknown; 1, 2 and 3 are known", ""};
}

/// Positions and corners one after the other, as they come in.
TriangleMesh plain_base(std::uint32_t vertices, std::uint32_t faces) {
    TriangleMesh base;
    base.positions.resize(vertices);
    base.faces.resize(faces);
    const std::byte* const from = incoming().data();
    std::memcpy(static_cast<void*>(base.positions.data()), from, vertices * sizeof(Vec3));
    std::memcpy(base.faces.data(), from + vertices * sizeof(Vec3), faces * sizeof(Triangle));
    return base;
}

Status begin(TriangleMesh base, std::uint32_t ghosts) {
    Expected<ProgressiveMesh> mesh = ProgressiveMesh::from_base(std::move(base), ghosts);
    if (!mesh) return Error{mesh.error().cause, "the base mesh: " + mesh.error().message, mesh.error().field};
    state().held.emplace(*std::move(mesh));
    look();
    return Done{};
}

}  // namespace

const View* view() { return &state().view; }

char* room(std::uint32_t bytes) {
    state().block.payload.resize(bytes);
    return state().block.payload.data();
}

std::uint32_t checksum(std::uint32_t before) { return crc32c(incoming(), before); }

bool set_grid(std::uint32_t encoding, std::uint32_t bits, double x, double y, double z, double step) {
    const Expected<PositionGrid> grid = grid_of(encoding, bits, {x, y, z}, step);
    if (!grid) return done(grid.error());
    if (*grid == state().grid) return true;
    state().grid = *grid;
    state().codec = RecordCodec(*grid);
    return true;
}

bool unpack(std::uint32_t vertices, std::uint32_t faces, std::uint32_t ghosts) {
    Expected<TriangleMesh> base = unpack_base({incoming(), vertices, faces, ghosts}, state().grid);
    if (!base) return done(base.error());
    state().base = *std::move(base);
    look_at(*state().base);
    return true;
}

bool begin_plain(std::uint32_t vertices, std::uint32_t faces, std::uint32_t ghosts) {
    return done(begin(plain_base(vertices, faces), ghosts));
}

void foresee(std::uint32_t splits) {
    state().held->foresee(splits);
    look();
}

bool append(std::uint32_t first, std::uint32_t count, std::uint32_t encoding, std::uint32_t crc) {
    RecordBlock& block = state().block;
    block.first = first;
    block.count = count;
    block.encoding = RecordEncoding{encoding};
    block.crc32c = crc;
    const bool appended = done(state().held->append(state().codec, block));
    look();
    return appended;
}

void coarsen(std::uint32_t levels) {
    state().held->coarsen(levels);
    look();
}

void refine(std::uint32_t level) {
    state().held->refine(level);
    look();
}

void rewind_to(std::uint32_t records) {
    state().held->rewind(records);
    look();
}

void follow() { state().held->follow(); }

void changes() {
    const std::vector<std::uint32_t>& faces = state().held->take_changes();
    state().view.changes = faces.data();
    state().view.change_count = static_cast<std::uint32_t>(faces.size());
}

}  // namespace vsplit::web

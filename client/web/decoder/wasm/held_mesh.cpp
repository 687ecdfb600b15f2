#include "held_mesh.h"

#include <algorithm>
#include <cassert>
#include <variant>

#include "mesh/half_edges.h"

namespace vsplit::web {

Status HeldMesh::append(RecordCodec& codec, const RecordBlock& block) {
    while (!undone_.empty()) redo();
    const std::size_t before = mesh_.records();
    Status decoded = codec.decode(block, mesh_);
    if (!decoded || !follows_) return decoded;
    // What a record is about shows while the mesh stands before it, which the codec does not tell: so it goes there once more.
    while (mesh_.records() > before) undo();
    while (!undone_.empty()) redo();
    return decoded;
}

void HeldMesh::undo() {
    undone_.push_back(mesh_.last());
    mesh_.rewind(mesh_.records() - 1);
    if (follows_) std::visit([this](const auto& record) { note(record); }, undone_.back());
}

void HeldMesh::redo() {
    std::visit(
        [this](const auto& record) {
            if (follows_) note(record);
            [[maybe_unused]] const Status applied = mesh_.refine(record);
            assert(applied.has_value());
        },
        undone_.back());
    undone_.pop_back();
}

void HeldMesh::coarsen(std::size_t levels) {
    const std::size_t target = mesh_.level() - std::min(levels, mesh_.level());
    const auto is_split = [this] { return std::holds_alternative<VertexSplit>(mesh_.last()); };
    while (mesh_.records() > 0 && (mesh_.level() > target || !is_split())) undo();
}

void HeldMesh::refine(std::size_t level) {
    while (!undone_.empty() && mesh_.level() < level) redo();
}

void HeldMesh::rewind(std::size_t records) {
    if (!follows_) mesh_.rewind(records);
    while (mesh_.records() > records) undo();
    undone_.clear();
}

void HeldMesh::note(const VertexSplit& split) {
    const TriangleMesh& mesh = mesh_.mesh();
    HalfEdge last = split.anchor;
    for (std::uint32_t step = 1; step < split.steps; ++step) last = mesh_.twins()[prev(last)];
    for (const HalfEdge corner : {split.anchor, next(split.anchor), prev(last)}) vertices_.add(origin(mesh, corner));
    vertices_.add(mesh.vertex_count());  // that it adds
}

void HeldMesh::note(EdgeFlip flip) {
    const HalfEdge twin = mesh_.twins()[flip.half_edge];
    for (const HalfEdge corner : {flip.half_edge, prev(flip.half_edge), twin, prev(twin)})
        vertices_.add(origin(mesh_.mesh(), corner));
}

const std::vector<std::uint32_t>& HeldMesh::take_changes() {
    vertices_.take([this](std::uint32_t vertex) {
        if (vertex >= mesh_.mesh().vertex_count()) return;
        const HalfEdge start = mesh_.corner_of(vertex);
        HalfEdge corner = start;
        do {
            faces_.add(face_of(corner));
            corner = mesh_.twins()[prev(corner)];
        } while (corner != start);
    });
    changes_.clear();
    faces_.take([this](std::uint32_t face) { changes_.push_back(face); });
    return changes_;
}

}  // namespace vsplit::web

#include "vsplit/mrr/progressive_mesh.h"

#include <algorithm>
#include <cassert>
#include <string>

#include "mesh/coordinate.h"
#include "mesh/half_edges.h"
#include "vsplit/mesh/inspect.h"

namespace vsplit {
namespace {

Error corrupt(std::size_t split, const std::string& what) {
    return {Cause::kCorrupt, "vertex split " + std::to_string(split) + ": " + what, ""};
}

Status check_indices_and_coordinates(const TriangleMesh& mesh) {
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
        for (const std::uint32_t v : mesh.faces[f]) {
            if (v >= mesh.vertex_count()) {
                return Error{Cause::kIndexOutOfRange,
                             "base mesh: face " + std::to_string(f) + " names vertex " + std::to_string(v) + " of " +
                                 std::to_string(mesh.vertex_count()),
                             ""};
            }
        }
    }
    for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
        if (!is_valid_position(mesh.positions[v])) {
            return Error{Cause::kInvalidCoordinate,
                         "base mesh: vertex " + std::to_string(v) + " has a coordinate that is not finite or beyond 1e15", ""};
        }
    }
    return Done{};
}

}  // namespace

Expected<ProgressiveMesh> ProgressiveMesh::from_base(TriangleMesh base) {
    if (Status valid = check_indices_and_coordinates(base); !valid) return valid.error();
    if (Status closed = require_closed_manifold(inspect(base)); !closed) return closed.error();
    ProgressiveMesh result;
    result.twin_ = half_edge_twins(base);
    result.mesh_ = std::move(base);
    return result;
}

Status ProgressiveMesh::check(const VertexSplit& split) const {
    if (split.anchor >= twin_.size()) {
        return corrupt(level(),
                       "anchor " + std::to_string(split.anchor) + " is no corner; the mesh has " + std::to_string(twin_.size()));
    }
    if (!is_valid_position(split.kept) || !is_valid_position(split.added)) {
        return corrupt(level(), "a coordinate is not finite or beyond 1e15");
    }
    if (split.steps == 0) return corrupt(level(), "0 steps; at least one face must move");
    HalfEdge corner = split.anchor;
    for (std::uint32_t step = 0; step < split.steps; ++step) {
        corner = twin_[prev(corner)];
        if (corner == split.anchor) {
            return corrupt(level(), std::to_string(split.steps) + " steps around a vertex of valence " +
                                        std::to_string(step + 1) + "; at most valence - 1 are possible");
        }
    }
    return Done{};
}

Status ProgressiveMesh::refine(std::span<const VertexSplit> splits) {
    mesh_.positions.reserve(mesh_.positions.size() + splits.size());
    mesh_.faces.reserve(mesh_.faces.size() + 2 * splits.size());
    twin_.reserve(twin_.size() + 6 * splits.size());
    undo_.reserve(undo_.size() + splits.size());
    for (const VertexSplit& split : splits) {
        if (Status valid = check(split); !valid) return valid;
        apply(split);
    }
    return Done{};
}

void ProgressiveMesh::apply(const VertexSplit& split) {
    const std::uint32_t v = origin(mesh_, split.anchor);
    const std::uint32_t w = mesh_.vertex_count();

    // The fan that moves: it begins at the edge (v, b) and ends at (v, e).
    const HalfEdge fan_begin = split.anchor;   // v -> b, soon w -> b
    const HalfEdge before = twin_[fan_begin];  // b -> v
    HalfEdge fan_end = kNone;                  // e -> v, soon e -> w
    HalfEdge after = fan_begin;                // v -> e, once the fan is walked
    for (std::uint32_t step = 0; step < split.steps; ++step) {
        mesh_.faces[face_of(after)][after % 3] = w;
        fan_end = prev(after);
        after = twin_[fan_end];
    }
    const std::uint32_t b = origin(mesh_, before);
    const std::uint32_t e = origin(mesh_, fan_end);

    const auto first = static_cast<HalfEdge>(twin_.size());
    const HalfEdge vw = first, we = first + 1, ev = first + 2;
    const HalfEdge wv = first + 3, vb = first + 4, bw = first + 5;
    mesh_.faces.push_back({v, w, e});
    mesh_.faces.push_back({w, v, b});
    twin_.insert(twin_.end(), {wv, fan_end, after, vw, before, fan_begin});
    twin_[fan_end] = we;
    twin_[after] = ev;
    twin_[before] = vb;
    twin_[fan_begin] = bw;

    undo_.push_back(mesh_.positions[v]);
    mesh_.positions[v] = split.kept;
    mesh_.positions.push_back(split.added);
}

void ProgressiveMesh::undo_last() {
    const auto first = static_cast<HalfEdge>(twin_.size() - 6);
    const std::uint32_t v = origin(mesh_, first);
    const HalfEdge fan_end = twin_[first + 1];
    const HalfEdge after = twin_[first + 2];
    const HalfEdge before = twin_[first + 4];
    const HalfEdge fan_begin = twin_[first + 5];
    for (HalfEdge corner = fan_begin;; corner = twin_[prev(corner)]) {
        mesh_.faces[face_of(corner)][corner % 3] = v;
        if (prev(corner) == fan_end) break;
    }
    twin_[fan_end] = after;
    twin_[after] = fan_end;
    twin_[before] = fan_begin;
    twin_[fan_begin] = before;
    twin_.resize(first);
    mesh_.faces.resize(mesh_.faces.size() - 2);
    mesh_.positions.pop_back();
    mesh_.positions[v] = undo_.back();
    undo_.pop_back();
}

void ProgressiveMesh::coarsen(std::size_t count) {
    for (std::size_t i = std::min(count, level()); i > 0; --i) undo_last();
}

TriangleMesh mesh_at(const MultiresMesh& mrr, std::size_t level) {
    Expected<ProgressiveMesh> mesh = ProgressiveMesh::from_base(mrr.base);
    assert(mesh.has_value());
    const std::size_t splits = std::min(level, mrr.splits.size());
    [[maybe_unused]] const Status refined = mesh->refine({mrr.splits.data(), splits});
    assert(refined.has_value());
    return mesh->mesh();
}

}  // namespace vsplit

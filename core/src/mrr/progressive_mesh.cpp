#include "vsplit/mrr/progressive_mesh.h"

#include <algorithm>
#include <cassert>
#include <string>

#include "base/huge_pages.h"
#include "mesh/cap_boundaries.h"
#include "mesh/coordinate.h"
#include "mesh/corners.h"
#include "mesh/half_edges.h"
#include "mesh/turn_edge.h"
#include "vsplit/mesh/inspect.h"

namespace vsplit {
namespace {

/// What is wrong with a record; refine says which one it was.
Error corrupt(const std::string& what) { return {Cause::kCorrupt, what, ""}; }

const char* name_of(const VertexSplit& /*record*/) { return "vertex split"; }
const char* name_of(EdgeFlip /*record*/) { return "edge flip"; }
const char* name_of(const VertexMove& /*record*/) { return "vertex move"; }

/// Room for `more`, twice as much at least: reserving exactly for every block would copy all of it for every block.
template <class Element>
void make_room(std::vector<Element>& elements, std::size_t more) {
    const std::size_t needed = elements.size() + more;
    if (needed > elements.capacity()) reserve_large(elements, std::max(needed, 2 * elements.capacity()));
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

Status check_ghosts(const TriangleMesh& mesh, std::uint32_t ghosts) {
    if (ghosts > mesh.vertex_count()) {
        return corrupt(std::to_string(ghosts) + " ghosts among " + std::to_string(mesh.vertex_count()) + " vertices");
    }
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
        const Triangle& face = mesh.faces[f];
        if (std::count_if(face.begin(), face.end(), [ghosts](std::uint32_t v) { return v < ghosts; }) < 2) continue;
        return corrupt("face " + std::to_string(f) + " joins two ghosts; each closes a boundary of its own");
    }
    if (count_ghost_faces(mesh, ghosts) < mesh.face_count()) return Done{};
    return Error{Cause::kEmptyInput, "every face touches a ghost; none is visible", ""};
}

}  // namespace

Expected<ProgressiveMesh> ProgressiveMesh::from_base(TriangleMesh base, std::uint32_t ghosts) {
    if (Status valid = check_indices_and_coordinates(base); !valid) return valid.error();
    if (Status closed = require_closed_manifold(inspect(base)); !closed) return closed.error();
    if (Status valid = check_ghosts(base, ghosts); !valid) return valid.error();
    ProgressiveMesh result;
    result.twin_ = half_edge_twins(base);
    result.corner_of_.resize(base.positions.size(), kNone);
    for (HalfEdge h = 0; h < result.twin_.size(); ++h) result.corner_of_[origin(base, h)] = h;
    result.mesh_ = std::move(base);
    result.ghosts_ = ghosts;
    return result;
}

Status ProgressiveMesh::find_fan(const VertexSplit& split) {
    if (split.anchor >= twin_.size()) {
        return corrupt("anchor " + std::to_string(split.anchor) + " is no corner; the mesh has " + std::to_string(twin_.size()));
    }
    if (split.steps == 0) return corrupt("0 steps; at least one face must move");
    HalfEdge corner = split.anchor;
    fan_.assign(1, corner);
    for (std::uint32_t step = 0; step < split.steps; ++step) {
        corner = twin_[prev(corner)];
        if (corner == split.anchor) {
            return corrupt(std::to_string(split.steps) + " steps around a vertex of valence " + std::to_string(step + 1) +
                           "; at most valence - 1 are possible");
        }
        fan_.push_back(corner);
    }
    return Done{};
}

bool ProgressiveMesh::is_beside_ghosts(const VertexSplit& split, const HalfEdge* corners) const {
    if (is_ghost(origin(mesh_, corners[0]))) return true;
    return is_ghost(origin(mesh_, next(corners[0]))) && is_ghost(origin(mesh_, prev(corners[split.steps - 1])));
}

Status ProgressiveMesh::check(const VertexSplit& split) {
    if (Status found = find_fan(split); !found) return found;
    if (!is_valid_position(split.kept) || !is_valid_position(split.added)) {
        return corrupt("a coordinate is not finite or beyond 1e15");
    }
    if (!is_beside_ghosts(split, fan_.data())) return Done{};
    const std::uint32_t vertex = origin(mesh_, split.anchor);
    if (is_ghost(vertex)) return corrupt("at vertex " + std::to_string(vertex) + ", a ghost");
    return corrupt("between two ghosts; it would make an edge without a visible face");
}

bool ProgressiveMesh::has_valence_of(std::uint32_t least, HalfEdge corner) const {
    HalfEdge at = corner;
    for (std::uint32_t valence = 1; valence < least; ++valence) {
        at = twin_[prev(at)];
        if (at == corner) return false;
    }
    return true;
}

/// Walks both rings at once: the smaller one decides.
bool ProgressiveMesh::are_joined(HalfEdge corner, HalfEdge other) const {
    const std::uint32_t from = origin(mesh_, corner);
    const std::uint32_t to = origin(mesh_, other);
    HalfEdge at = corner;
    HalfEdge at_other = other;
    do {
        if (origin(mesh_, next(at)) == to || origin(mesh_, next(at_other)) == from) return true;
        at = twin_[prev(at)];
        at_other = twin_[prev(at_other)];
    } while (at != corner && at_other != other);
    return false;
}

Status ProgressiveMesh::check(EdgeFlip flip) const {
    const HalfEdge h = flip.half_edge;
    if (h >= twin_.size()) {
        return corrupt(std::to_string(h) + " is no half-edge; the mesh has " + std::to_string(twin_.size()));
    }
    const HalfEdge g = twin_[h];
    for (const HalfEdge corner : {h, prev(h), g, prev(g)}) {
        if (is_ghost(origin(mesh_, corner)))
            return corrupt("beside vertex " + std::to_string(origin(mesh_, corner)) + ", a ghost");
    }
    for (const HalfEdge end : {h, g}) {
        if (!has_valence_of(4, end)) {
            return corrupt("at vertex " + std::to_string(origin(mesh_, end)) +
                           " of valence under 4, which would keep under 3 edges");
        }
    }
    if (are_joined(prev(h), prev(g))) {
        return corrupt("to vertices " + std::to_string(origin(mesh_, prev(h))) + " and " +
                       std::to_string(origin(mesh_, prev(g))) + ", which have an edge already");
    }
    return Done{};
}

Status ProgressiveMesh::check(const VertexMove& move) const {
    if (move.vertex >= mesh_.vertex_count()) {
        return corrupt(std::to_string(move.vertex) + " is no vertex; the mesh has " + std::to_string(mesh_.vertex_count()));
    }
    if (is_ghost(move.vertex)) return corrupt("of vertex " + std::to_string(move.vertex) + ", a ghost");
    if (!is_valid_position(move.position)) return corrupt("a coordinate is not finite or beyond 1e15");
    return Done{};
}

template <class AnyRecord>
Status ProgressiveMesh::take(const AnyRecord& record) {
    if (check(record)) {
        apply(record);
        return Done{};
    }
    return refuse(record);
}

template <class AnyRecord>
Status ProgressiveMesh::refuse(const AnyRecord& record) {
    Error error = check(record).error();
    error.message = "record " + std::to_string(records()) + ", " + name_of(record) + ": " + error.message;
    return error;
}

template Status ProgressiveMesh::take(const VertexSplit& record);
template Status ProgressiveMesh::take(const EdgeFlip& record);
template Status ProgressiveMesh::take(const VertexMove& record);
template Status ProgressiveMesh::refuse(const VertexSplit& record);

void ProgressiveMesh::reserve(std::size_t splits, std::size_t flips, std::size_t moves) {
    make_room(mesh_.positions, splits);
    make_room(mesh_.faces, 2 * splits);
    make_room(twin_, 6 * splits);
    make_room(corner_of_, splits);
    make_room(applied_, splits + flips + moves);
    make_room(edited_, flips + moves);
    make_room(lay_, splits + moves);
}

void ProgressiveMesh::foresee(std::size_t splits) { reserve(std::min(splits, kMostForeseen * mesh_.positions.size()), 0, 0); }

Status ProgressiveMesh::refine(const RecordSpan& records) {
    assert(records.consistent());
    reserve(records.splits.size(), records.flips.size(), records.moves.size());
    auto split = records.splits.begin();
    auto flip = records.flips.begin();
    auto move = records.moves.begin();
    for (const RecordKind kind : records.kinds) {
        Status taken = kind == RecordKind::kSplit ? take(*split++) : kind == RecordKind::kFlip ? take(*flip++) : take(*move++);
        if (!taken) return taken;
    }
    return Done{};
}

/// The six corners of the faces beside an edge that was turned.
void ProgressiveMesh::note_corners_beside(HalfEdge half_edge) {
    for (const HalfEdge side : {half_edge, twin_[half_edge]}) {
        for (const HalfEdge corner : {side, next(side), prev(side)}) corner_of_[origin(mesh_, corner)] = corner;
    }
}

void ProgressiveMesh::apply(EdgeFlip flip) {
    turn_clockwise(mesh_, twin_, flip.half_edge);
    note_corners_beside(flip.half_edge);
    edited_.push_back(flip.half_edge);
    applied_.push_back(RecordKind::kFlip);
}

void ProgressiveMesh::apply(const VertexMove& move) {
    lay_.push_back(mesh_.positions[move.vertex]);
    mesh_.positions[move.vertex] = move.position;
    edited_.push_back(move.vertex);
    applied_.push_back(RecordKind::kMove);
}

void ProgressiveMesh::apply(const VertexSplit& split, const HalfEdge* corners) {
    const HalfEdge fan_begin = corners[0];                    // v -> b, soon w -> b
    const HalfEdge fan_end = prev(corners[split.steps - 1]);  // e -> v, soon e -> w
    const HalfEdge after = corners[split.steps];              // v -> e
    const HalfEdge before = twin_[fan_begin];                 // b -> v
    std::uint32_t* vertex_at = corners_of(mesh_.faces);
    const std::uint32_t v = vertex_at[fan_begin];
    const std::uint32_t w = mesh_.vertex_count();
    const std::uint32_t b = vertex_at[before];
    const std::uint32_t e = vertex_at[fan_end];
    for (std::uint32_t n = 0; n < split.steps; ++n) vertex_at[corners[n]] = w;

    const auto first = static_cast<HalfEdge>(twin_.size());
    const HalfEdge vw = first, we = first + 1, ev = first + 2;
    const HalfEdge wv = first + 3, vb = first + 4, bw = first + 5;
    mesh_.faces.push_back({v, w, e});
    mesh_.faces.push_back({w, v, b});
    for (const HalfEdge twin : {wv, fan_end, after, vw, before, fan_begin}) twin_.push_back(twin);
    twin_[fan_end] = we;
    twin_[after] = ev;
    twin_[before] = vb;
    twin_[fan_begin] = bw;

    corner_of_[v] = first;
    corner_of_.push_back(first + 1);
    lay_.push_back(mesh_.positions[v]);
    mesh_.positions[v] = split.kept;
    mesh_.positions.push_back(split.added);
    if (is_ghost(b) || is_ghost(e)) border_splits_.push_back(static_cast<std::uint32_t>(level_));
    ++level_;
    applied_.push_back(RecordKind::kSplit);
}

void ProgressiveMesh::undo_split() {
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
    corner_of_.pop_back();
    // A flip may have left e or b with a corner of the faces that go.
    for (const HalfEdge corner : {fan_begin, fan_end, before}) corner_of_[origin(mesh_, corner)] = corner;
    mesh_.positions[v] = lay_.back();
    lay_.pop_back();
    --level_;
    if (!border_splits_.empty() && border_splits_.back() == level_) border_splits_.pop_back();
}

VertexSplit ProgressiveMesh::last_split() const {
    const auto first = static_cast<HalfEdge>(twin_.size() - 6);
    const HalfEdge fan_end = twin_[first + 1];
    VertexSplit split{twin_[first + 5], 1, mesh_.positions[origin(mesh_, first)], mesh_.positions.back()};
    for (HalfEdge corner = split.anchor; prev(corner) != fan_end; corner = twin_[prev(corner)]) ++split.steps;
    return split;
}

Record ProgressiveMesh::last() const {
    if (applied_.back() == RecordKind::kSplit) return last_split();
    if (applied_.back() == RecordKind::kFlip) return EdgeFlip{edited_.back()};
    return VertexMove{edited_.back(), mesh_.positions[edited_.back()]};
}

void ProgressiveMesh::undo_last() {
    const RecordKind kind = applied_.back();
    applied_.pop_back();
    if (kind == RecordKind::kSplit) {
        undo_split();
        return;
    }
    const std::uint32_t edited = edited_.back();
    edited_.pop_back();
    if (kind == RecordKind::kFlip) {
        turn_counter_clockwise(mesh_, twin_, edited);
        note_corners_beside(edited);
        return;
    }
    mesh_.positions[edited] = lay_.back();
    lay_.pop_back();
}

void ProgressiveMesh::rewind(std::size_t records) {
    while (applied_.size() > records) undo_last();
}

void ProgressiveMesh::coarsen(std::size_t levels) {
    const std::size_t target = level_ - std::min(levels, level_);
    while (!applied_.empty() && (level_ > target || applied_.back() != RecordKind::kSplit)) undo_last();
}

TriangleMesh ProgressiveMesh::visible() const { return visible_mesh(mesh_, ghosts_); }

TriangleMesh visible_of(const ProgressiveMesh& mesh, const MultiresMesh& mrr) {
    if (mrr.regions.size() < mesh.mesh().faces.size()) return mesh.visible();
    TriangleMesh complex = mesh.mesh();
    complex.regions.assign(mrr.regions.begin(), mrr.regions.begin() + static_cast<std::ptrdiff_t>(complex.faces.size()));
    complex.sets = mrr.sets;
    return visible_mesh(std::move(complex), mrr.ghosts);
}

TriangleMesh mesh_at(const MultiresMesh& mrr, std::size_t level) {
    Expected<ProgressiveMesh> mesh = ProgressiveMesh::from_base(mrr.base, mrr.ghosts);
    assert(mesh.has_value());
    const std::size_t records = mrr.record_of_level(std::min(level, mrr.levels()));
    [[maybe_unused]] const Status refined = mesh->refine(mrr.records.slice(0, records));
    assert(refined.has_value());
    return visible_of(*mesh, mrr);
}

}  // namespace vsplit

#include "simplify/collapse_log.h"

#include <algorithm>
#include <span>
#include <utility>

#include "mrr/face_walk.h"

namespace vsplit {
namespace {

/// Where each half-edge goes: faces of the base mesh keep their corners' order, faces that come back start at the corner given.
class Renumbering {
public:
    explicit Renumbering(HalfEdge half_edges) : first_(half_edges / 3, kNone) {}

    /// The face of `first_corner` becomes face `number`, which starts at that corner.
    void set_face(HalfEdge first_corner, std::uint32_t number) {
        first_[face_of(first_corner)] = 3 * number + (3 - first_corner % 3) % 3;
    }
    /// first_ holds where corner 0 of the old face went; the others follow in order.
    [[nodiscard]] HalfEdge operator[](HalfEdge h) const {
        const HalfEdge zero = first_[face_of(h)];
        return zero - zero % 3 + (zero + h) % 3;
    }

private:
    std::vector<HalfEdge> first_;
};

/// What is left of the simplified mesh, and the numbers its parts get.
class Builder {
public:
    explicit Builder(const HalfEdgeMesh& mesh) : vertex_(mesh.vertex_count(), kNone), half_edge_(mesh.half_edge_count()) {
        const std::uint32_t ghosts = mesh.ghosts();
        mrr_.ghosts = ghosts;
        const auto is_there = [&mesh](std::uint32_t face) { return !mesh.removed(3 * face); };
        const auto twin = [&mesh](HalfEdge h) { return mesh.twin(h); };
        for (std::uint32_t v = 0; v < ghosts; ++v) number(mesh, v);
        for (const HalfEdge h : walk_faces(mesh.half_edge_count() / 3, is_there, twin)) {
            half_edge_.set_face(h, mrr_.base.face_count());
            for (const HalfEdge corner : {h, next(h), prev(h)}) number(mesh, mesh.origin(corner));
            mrr_.base.faces.push_back({vertex_[mesh.origin(h)], vertex_[mesh.target(h)], vertex_[mesh.origin(prev(h))]});
        }
        mrr_.ghost_faces = count_ghost_faces(mrr_.base, ghosts);
    }

    void add_moves(std::span<const VertexMove> moves) {
        moves_.clear();
        for (const VertexMove& move : moves) moves_.push_back({vertex_[move.vertex], move.position});
        const auto by_vertex = [](const VertexMove& left, const VertexMove& right) { return left.vertex < right.vertex; };
        std::sort(moves_.begin(), moves_.end(), by_vertex);  // each is moved once
        for (const VertexMove& move : moves_) mrr_.records.push_back(move);
    }
    void add_flip(HalfEdge h) { mrr_.records.push_back(EdgeFlip{half_edge_[h]}); }

    /// Vertex `stayed` of the mesh stood for both until now; from here on it is `kept`.
    void give_number(std::uint32_t stayed, std::uint32_t kept) { vertex_[kept] = vertex_[stayed]; }

    /// The faces of ij and ji come back, and vertex `removed`. The anchor's face was alive when the collapse was made, so it is
    /// numbered by now.
    void add_split(VertexSplit split, HalfEdge ij, HalfEdge ji, std::uint32_t removed) {
        const auto number = static_cast<std::uint32_t>(mrr_.levels());
        const std::uint32_t first_face = mrr_.base.face_count() + 2 * number;
        split.anchor = half_edge_[split.anchor];
        mrr_.records.push_back(split);
        vertex_[removed] = mrr_.base.vertex_count() + number;
        half_edge_.set_face(ij, first_face);
        half_edge_.set_face(ji, first_face + 1);
    }

    [[nodiscard]] MultiresMesh& mrr() { return mrr_; }

private:
    void number(const HalfEdgeMesh& mesh, std::uint32_t v) {
        if (vertex_[v] != kNone || mesh.outgoing(v) == kNone) return;
        vertex_[v] = mrr_.base.vertex_count();
        mrr_.base.positions.push_back(mesh.position(v));
    }

    MultiresMesh mrr_;
    std::vector<VertexMove> moves_;
    std::vector<std::uint32_t> vertex_;
    Renumbering half_edge_;
};

}  // namespace

void CollapseLog::record(const HalfEdgeMesh& mesh, const EdgeStar& star, const Vec3& position) {
    keep_net_moves(mesh);
    const std::uint32_t i = mesh.origin(star.ij);
    const std::uint32_t j = mesh.origin(star.ji);
    const std::uint32_t valence_i = mesh.valence(i), valence_j = mesh.valence(j);
    Entry entry;
    // The fan of j begins at b, that of i at e.
    const auto distance = [&](HalfEdge h) { return (mesh.position(mesh.origin(h)) - position).squaredNorm(); };
    entry.is_gone_new = valence_i == valence_j ? distance(star.bj) <= distance(star.ei) : valence_j < valence_i;
    entry.ij = entry.is_gone_new ? star.ij : star.ji;
    entry.ji = entry.is_gone_new ? star.ji : star.ij;
    entry.anchor = entry.is_gone_new ? star.jb : star.ie;
    entry.steps = static_cast<std::uint16_t>(std::min(valence_i, valence_j) - 2);
    entry.is_at_border = mesh.is_ghost(mesh.origin(star.ei)) || mesh.is_ghost(mesh.origin(star.bj));
    entry.stayed_at = mesh.position(i);
    entries_.push_back(entry);
    stayed_ = i;
    if (flips_.empty() && moves_.empty() && edits_.empty()) return;
    edits_.push_back({static_cast<std::uint32_t>(flips_.size()), static_cast<std::uint32_t>(moves_.size())});
}

void CollapseLog::record_flip(HalfEdge h) {
    if (size() > 0) flips_.push_back(h);
}

void CollapseLog::record_move(const HalfEdgeMesh& mesh, std::uint32_t v) {
    if (size() == 0 || v == stayed_) return;
    if (!moved_in_) moved_in_ = std::make_shared<std::vector<std::uint32_t>>(mesh.vertex_count(), 0);
    const auto step = static_cast<std::uint32_t>(size());
    if (std::exchange((*moved_in_)[v], step) != step) moves_.push_back({v, mesh.position(v)});
}

CollapseLog CollapseLog::fork(const HalfEdgeMesh& mesh) {
    if (!moved_in_) moved_in_ = std::make_shared<std::vector<std::uint32_t>>(mesh.vertex_count(), 0);
    CollapseLog part;
    part.stayed_ = stayed_;
    part.moved_in_ = moved_in_;
    part.before_ = size();
    return part;
}

void CollapseLog::append(CollapseLog part) {
    const Edits before{static_cast<std::uint32_t>(flips_.size()), static_cast<std::uint32_t>(moves_.size())};
    const std::size_t plain = part.entries_.size() - part.edits_.size();  // collapses before which the part had no edits
    for (std::size_t n = 0; n < part.entries_.size(); ++n) {
        const Edits own = n < plain ? Edits{} : part.edits_[n - plain];
        const Edits all{before.flips + own.flips, before.moves + own.moves};
        if (!edits_.empty() || all.flips > 0 || all.moves > 0) edits_.push_back(all);
    }
    if (!part.entries_.empty()) stayed_ = part.stayed_;
    entries_.insert(entries_.end(), part.entries_.begin(), part.entries_.end());
    flips_.insert(flips_.end(), part.flips_.begin(), part.flips_.end());
    moves_.insert(moves_.end(), part.moves_.begin(), part.moves_.end());
}

/// Drops the moves of the step that ends here whose vertex is back where it lay.
void CollapseLog::keep_net_moves(const HalfEdgeMesh& mesh) {
    if (entries_.empty()) return;
    const auto in_vain = [&mesh](const VertexMove& move) { return mesh.position(move.vertex) == move.position; };
    moves_.erase(std::remove_if(moves_.begin() + last_edits().moves, moves_.end(), in_vain), moves_.end());
}

MultiresMesh CollapseLog::build(const HalfEdgeMesh& mesh) {
    keep_net_moves(mesh);
    Builder builder(mesh);
    builder.mrr().records.reserve(entries_.size(), flips_.size(), moves_.size());
    for (; !entries_.empty(); entries_.pop_back()) {
        const Entry& entry = entries_.back();
        const Edits before = last_edits();
        if (!edits_.empty()) edits_.pop_back();
        for (; flips_.size() > before.flips; flips_.pop_back()) builder.add_flip(flips_.back());
        builder.add_moves(std::span(moves_).subspan(before.moves));
        moves_.resize(before.moves);
        if (entry.is_at_border) builder.mrr().border_splits.push_back(static_cast<std::uint32_t>(builder.mrr().levels()));
        // Of ij and ji the vertex kept and the new one: removed half-edges have their origins still.
        const std::uint32_t kept = mesh.origin(entry.ij), added = mesh.origin(entry.ji);
        const Vec3& gone_at = mesh.position(entry.is_gone_new ? added : kept);
        builder.give_number(entry.is_gone_new ? kept : added, kept);
        const VertexSplit split{entry.anchor, entry.steps, entry.is_gone_new ? entry.stayed_at : gone_at,
                                entry.is_gone_new ? gone_at : entry.stayed_at};
        builder.add_split(split, entry.ij, entry.ji, added);
    }
    clear();
    return std::move(builder.mrr());
}

}  // namespace vsplit

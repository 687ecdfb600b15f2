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
    Builder(const HalfEdgeMesh& mesh, std::uint32_t ghosts)
        : vertex_(mesh.vertex_count(), kNone), half_edge_(mesh.half_edge_count()) {
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

    /// Vertex `left` of the mesh stood for both until now; from here on it is `kept`.
    void give_number(std::uint32_t left, std::uint32_t kept) { vertex_[kept] = vertex_[left]; }

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

void CollapseLog::record(const HalfEdgeMesh& mesh, const EdgeStar& star) {
    keep_net_moves(mesh);
    const std::uint32_t i = mesh.origin(star.ij);
    const std::uint32_t j = mesh.origin(star.ji);
    const std::uint32_t valence_i = mesh.valence(i), valence_j = mesh.valence(j);
    const bool is_j_new = valence_j <= valence_i;
    Entry entry;
    entry.ij = is_j_new ? star.ij : star.ji;
    entry.ji = is_j_new ? star.ji : star.ij;
    entry.anchor = is_j_new ? star.jb : star.ie;
    entry.kept = is_j_new ? i : j;
    entry.removed = is_j_new ? j : i;
    entry.left = i;
    entry.steps = std::min(valence_i, valence_j) - 2;
    entry.least_wing = std::min(mesh.origin(star.ei), mesh.origin(star.bj));
    entry.first_flip = static_cast<std::uint32_t>(flips_.size());
    entry.first_move = static_cast<std::uint32_t>(moves_.size());
    entry.kept_at = mesh.position(entry.kept);
    entry.removed_at = mesh.position(entry.removed);
    entries_.push_back(entry);
}

void CollapseLog::record_flip(HalfEdge h) {
    if (!entries_.empty()) flips_.push_back(h);
}

void CollapseLog::record_move(std::uint32_t v, const Vec3& before) {
    if (entries_.empty() || v == entries_.back().left) return;
    if (v >= moved_in_.size()) moved_in_.resize(std::max<std::size_t>(v + std::size_t{1}, 2 * moved_in_.size()), 0);
    const auto step = static_cast<std::uint32_t>(entries_.size());
    if (std::exchange(moved_in_[v], step) != step) moves_.push_back({v, before});
}

/// Drops the moves of the step that ends here whose vertex is back where it lay.
void CollapseLog::keep_net_moves(const HalfEdgeMesh& mesh) {
    if (entries_.empty()) return;
    const auto in_vain = [&mesh](const VertexMove& move) { return mesh.position(move.vertex) == move.position; };
    moves_.erase(std::remove_if(moves_.begin() + entries_.back().first_move, moves_.end(), in_vain), moves_.end());
}

MultiresMesh CollapseLog::build(const HalfEdgeMesh& mesh, std::uint32_t ghosts) {
    keep_net_moves(mesh);
    Builder builder(mesh, ghosts);
    builder.mrr().records.reserve(entries_.size(), flips_.size(), moves_.size());
    for (; !entries_.empty(); entries_.pop_back()) {
        const Entry& entry = entries_.back();
        for (; flips_.size() > entry.first_flip; flips_.pop_back()) builder.add_flip(flips_.back());
        builder.add_moves(std::span(moves_).subspan(entry.first_move));
        moves_.resize(entry.first_move);
        builder.give_number(entry.left, entry.kept);
        if (entry.least_wing < ghosts) builder.mrr().border_splits.push_back(static_cast<std::uint32_t>(builder.mrr().levels()));
        builder.add_split({entry.anchor, entry.steps, entry.kept_at, entry.removed_at}, entry.ij, entry.ji, entry.removed);
    }
    clear();
    return std::move(builder.mrr());
}

}  // namespace vsplit

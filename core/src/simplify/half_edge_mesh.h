#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <vector>

#include "mesh/half_edges.h"
#include "vsplit/mesh/triangle_mesh.h"

namespace vsplit {

/// The half-edges around an edge (i, j), named as in VertexSplit: the faces (i, j, e) and (j, i, b) vanish when j collapses into
/// i.
struct EdgeStar {
    HalfEdge ij = 0, je = 0, ei = 0;  ///< face (i, j, e)
    HalfEdge ji = 0, ib = 0, bj = 0;  ///< face (j, i, b)
    HalfEdge ej = 0, ie = 0;          ///< twins of je and ei
    HalfEdge bi = 0, jb = 0;          ///< twins of ib and bj
};

/// A number that threads change at the same time. A copy is of what it is then.
class SharedCount {
public:
    explicit SharedCount(std::uint32_t value = 0) : value_(value) {}
    SharedCount(const SharedCount& other) : value_(other.get()) {}
    SharedCount& operator=(const SharedCount& other) {
        value_.store(other.get(), std::memory_order_relaxed);
        return *this;
    }
    ~SharedCount() = default;

    [[nodiscard]] std::uint32_t get() const { return value_.load(std::memory_order_relaxed); }
    void add(std::uint32_t more) { value_.fetch_add(more, std::memory_order_relaxed); }
    void take(std::uint32_t fewer) { value_.fetch_sub(fewer, std::memory_order_relaxed); }

private:
    std::atomic<std::uint32_t> value_;
};

/// Connectivity of a closed 2-manifold that never gets finer: 24 bytes a face, faces and vertices keep their numbers.
/// Positions live here too, since every walk needs them.
class HalfEdgeMesh {
public:
    /// The first `ghosts` vertices close open boundaries (see CappedMesh).
    /// \pre `mesh` is a closed, consistently oriented 2-manifold.
    explicit HalfEdgeMesh(const TriangleMesh& mesh, std::uint32_t ghosts = 0);

    [[nodiscard]] std::uint32_t vertex_count() const { return static_cast<std::uint32_t>(positions_.size()); }
    [[nodiscard]] HalfEdge half_edge_count() const { return static_cast<HalfEdge>(half_edges_.size()); }
    [[nodiscard]] std::uint32_t ghosts() const { return ghosts_; }
    [[nodiscard]] bool is_ghost(std::uint32_t v) const { return v < ghosts_; }

    /// Visible ones: those at a ghost do not count.
    [[nodiscard]] std::uint32_t live_faces() const { return live_faces_.get(); }

    [[nodiscard]] std::uint32_t origin(HalfEdge h) const { return half_edges_[h].origin; }
    [[nodiscard]] std::uint32_t target(HalfEdge h) const { return half_edges_[next(h)].origin; }
    [[nodiscard]] HalfEdge twin(HalfEdge h) const { return half_edges_[h].twin; }
    /// The next half-edge counter-clockwise around the origin of h.
    [[nodiscard]] HalfEdge turn(HalfEdge h) const { return half_edges_[prev(h)].twin; }
    /// Some half-edge that leaves v.
    [[nodiscard]] HalfEdge outgoing(std::uint32_t v) const { return outgoing_[v]; }
    [[nodiscard]] std::uint32_t valence(std::uint32_t v) const { return valence_[v]; }
    [[nodiscard]] const Vec3& position(std::uint32_t v) const { return positions_[v]; }
    [[nodiscard]] bool removed(HalfEdge h) const { return half_edges_[h].twin == kNone; }

    /// Whether a face is there, and not one at a ghost.
    [[nodiscard]] bool visible(std::uint32_t face) const {
        const HalfEdge h = 3 * face;
        return !removed(h) && (ghosts_ == 0 || std::min({origin(h), origin(h + 1), origin(h + 2)}) >= ghosts_);
    }

    /// The number an edge goes by: the smaller of its half-edges.
    [[nodiscard]] HalfEdge edge_of(HalfEdge h) const { return std::min(h, twin(h)); }

    [[nodiscard]] EdgeStar star(HalfEdge h) const;

    /// Whether collapsing the edge of h would pinch the surface: its ends share a neighbour besides the two across it (the link
    /// condition). O(product of valences).
    [[nodiscard]] bool pinches(HalfEdge h) const;

    /// Collapses j into i, which moves to `position`. What is removed keeps its place and its half-edges their origins. Two faces
    /// and one vertex fewer; on a boundary one of the two is a ghost's. \pre the link condition holds for the edge. O(valence of
    /// j).
    void collapse(const EdgeStar& star, const Vec3& position);

    template <class Visit>
    void for_each_outgoing(std::uint32_t v, Visit visit) const {
        const HalfEdge first = outgoing_[v];
        HalfEdge h = first;
        do {
            visit(h);
            h = turn(h);
        } while (h != first);
    }

    /// Turns the edge of h counter-clockwise within the quad of its two faces; see turn_counter_clockwise.
    /// \pre both ends have valence 4 or more, and the vertices opposite have no edge yet. O(1).
    void flip(HalfEdge h);

    /// O(valence).
    void move(std::uint32_t v, const Vec3& to) {
        positions_[v] = to;
        touch_around(v);
    }

    /// Counts flips, moves and calls of touch_around. Threads that change parts of the mesh at the same time share it: what a
    /// part changes is later than what the clock showed before, to the thread that looked.
    [[nodiscard]] std::uint32_t clock() const { return clock_.get(); }
    /// The clock when a face at v changed last by one of these. A collapse leaves it to its caller, who has the ring at hand.
    [[nodiscard]] std::uint32_t changed_at(std::uint32_t v) const { return changed_at_[v]; }
    void touch(std::uint32_t v) { changed_at_[v] = clock(); }
    /// All faces at v are others. O(valence).
    void touch_around(std::uint32_t v) {
        tick();
        touch(v);
        for_each_outgoing(v, [this](HalfEdge h) { touch(target(h)); });
    }

    /// Whether the edge of h is a crease. Edges that a collapse joins are one when either was; a flipped edge keeps its mark.
    [[nodiscard]] bool is_crease(HalfEdge h) const { return marks(h) != 0; }
    void unmark_crease(HalfEdge h) { put_marks(h, 0); }
    void mark_crease(HalfEdge h) { put_marks(h, kCrease); }

    /// A crease that counts as one whatever the angle between its faces.
    [[nodiscard]] bool is_kept_flat(HalfEdge h) const { return (marks(h) & kKeptFlat) != 0; }
    void mark_kept_flat(HalfEdge h) { put_marks(h, kCrease | kKeptFlat); }

private:
    HalfEdgeMesh(const TriangleMesh& mesh, const std::vector<HalfEdge>& twins, std::uint32_t ghosts);
    void tick() { clock_.add(1); }
    void pair(HalfEdge h, HalfEdge g) {
        half_edges_[h].twin = g;
        half_edges_[g].twin = h;
    }

    /// As pair, of two edges that become one.
    void join(HalfEdge h, HalfEdge g) {
        pair(h, g);
        put_marks(h, marks(h) | marks(g));
    }

    [[nodiscard]] unsigned marks(HalfEdge h) const { return creases_[h / 4] >> (h % 4 * 2) & 3U; }
    void put_mark(HalfEdge h, unsigned mark) {
        const unsigned shift = h % 4 * 2;
        creases_[h / 4] = static_cast<std::uint8_t>((creases_[h / 4] & ~(3U << shift)) | mark << shift);
    }
    void put_marks(HalfEdge h, unsigned mark) {
        put_mark(h, mark);
        put_mark(twin(h), mark);
    }

    /// Side by side, since walks need both: a face's three lie in one or two cache lines.
    struct Link {
        std::uint32_t origin = 0;
        HalfEdge twin = kNone;  // kNone in removed faces
    };
    std::vector<Link> half_edges_;
    static constexpr unsigned kCrease = 1, kKeptFlat = 2;
    std::vector<std::uint8_t> creases_;  // marks of four half-edges a byte, the same for both of an edge
    std::vector<HalfEdge> outgoing_;
    std::vector<std::uint32_t> valence_;
    std::vector<Vec3> positions_;
    std::vector<std::uint32_t> changed_at_;
    SharedCount clock_;
    std::uint32_t ghosts_ = 0;
    SharedCount live_faces_;
};

}  // namespace vsplit

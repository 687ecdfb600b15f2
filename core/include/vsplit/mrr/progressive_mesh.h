#pragma once

#include <cstdint>
#include <vector>

#include "vsplit/base/expected.h"
#include "vsplit/mrr/multires_mesh.h"

namespace vsplit {

/// A mesh that moves between the levels of an MRR by applying and undoing records. The server and every client build their
/// meshes through this class, so a level is the same everywhere, bit for bit.
///
///     auto mesh = ProgressiveMesh::from_base(mrr.base, mrr.ghosts);
///     mesh->refine(mrr.records);     // to the finest level
///     mesh->coarsen(100);            // 100 levels down again
///     draw(mesh->visible());
///
/// Records may come from the network: each is checked against the mesh before anything is changed.
/// Not thread-safe; distinct objects are independent. Memory: 24 bytes a face for connectivity, 28 a vertex, and
/// for undoing 25 a split, 5 a flip, 29 a move.
class ProgressiveMesh {
public:
    /// `ghosts`: how many of the first vertices are ghosts (see MultiresMesh).
    /// \return NON_MANIFOLD, OPEN_MESH, INDEX_OUT_OF_RANGE or INVALID_COORDINATE when `base` is no closed 2-manifold; CORRUPT for
    /// more ghosts than vertices or a face that joins two; EMPTY_INPUT when no face is visible. O(faces log faces).
    [[nodiscard]] static Expected<ProgressiveMesh> from_base(TriangleMesh base, std::uint32_t ghosts = 0);

    /// Applies records in order; the first is record number records(). Any run will do, also one that begins or ends between
    /// two splits.
    ///
    /// Refused are: a split whose anchor is no corner, that moves no face or all, at a ghost or between two; a flip of no
    /// half-edge, of an edge with an end of valence 3, of one beside a ghost, or to an edge that is there already; a move of no
    /// vertex or of a ghost; a coordinate that is not finite or beyond 1e15.
    /// \return CORRUPT naming the record's number; the mesh then stands as the records before it left it. O(records * ring).
    /// \pre records.consistent().
    [[nodiscard]] Status refine(const RecordSpan& records);

    /// One record; otherwise as above. O(ring).
    [[nodiscard]] Status refine(const VertexSplit& split) { return take(split); }
    [[nodiscard]] Status refine(EdgeFlip flip) { return take(flip); }
    [[nodiscard]] Status refine(const VertexMove& move) { return take(move); }

    /// The same for who has walked around the vertex: corners[n] is its corner in the face that comes n after that of the anchor,
    /// corners[steps] the one in the first face that stays. \pre so it is; 0 < steps < valence; the positions are valid.
    /// \return CORRUPT for a split at a ghost or between two. O(steps).
    [[nodiscard]] Status refine(const VertexSplit& split, const std::uint32_t* corners) {
        if (ghosts_ > 0 && is_beside_ghosts(split, corners)) return refuse(split);
        apply(split, corners);
        return Done{};
    }

    /// Makes room for so many records more at once.
    void reserve(std::size_t splits, std::size_t flips, std::size_t moves);

    /// The same for splits that a file or a stream announces, as far as they are at most kMostForeseen times as many as there are
    /// vertices: what is merely announced is no reason to take much.
    void foresee(std::size_t splits);
    static constexpr std::size_t kMostForeseen = 64;

    /// Undoes the edits after the last split, then the last `levels` splits, at most all, each with the edits before it: the mesh
    /// is a level again. O(records undone * ring). Needs no records.
    void coarsen(std::size_t levels);

    /// Undoes records until `records` of those applied are left; nothing when there are no more than that. O(as coarsen).
    void rewind(std::size_t records);

    /// The record applied last, as it can be applied again once it is undone. \pre records() > 0. O(its steps).
    [[nodiscard]] Record last() const;

    /// Splits applied so far.
    [[nodiscard]] std::size_t level() const { return level_; }

    /// Records applied so far.
    [[nodiscard]] std::size_t records() const { return applied_.size(); }

    /// The mesh as it stands, ghosts included. The reference stays valid; its content changes with refine and coarsen.
    [[nodiscard]] const TriangleMesh& mesh() const { return mesh_; }

    /// The mesh as it stands, without ghosts. O(faces).
    [[nodiscard]] TriangleMesh visible() const;

    [[nodiscard]] std::uint32_t ghosts() const { return ghosts_; }

    /// Of the half-edge that leaves a corner, the one that runs back.
    [[nodiscard]] const std::vector<std::uint32_t>& twins() const { return twin_; }

    /// A corner at a vertex; which one depends on how the mesh was reached. \pre vertex < mesh().vertex_count().
    [[nodiscard]] std::uint32_t corner_of(std::uint32_t vertex) const { return corner_of_[vertex]; }

    /// Splits applied so far that added one visible face; see MultiresMesh.
    [[nodiscard]] const std::vector<std::uint32_t>& border_splits() const { return border_splits_; }

    /// WebAssembly has no way to ask for memory but to read it; who does not look at what is read does not wait for it.
    static void prefetch(const void* place) {
#ifdef __wasm__
        static_cast<void>(*static_cast<const volatile char*>(place));
#else
        __builtin_prefetch(place);
#endif
    }

    /// Ask for the memory that corner_of, a position, or the face of a corner lies in; harmless where that is not needed after
    /// all.
    void prefetch_corner_of(std::uint32_t vertex) const { prefetch(corner_of_.data() + vertex); }
    void prefetch_position(std::uint32_t vertex) const {
        const double* const position = mesh_.positions.data()[vertex].data();
        prefetch(position);
        prefetch(position + 2);  // a quarter of them lie in two cache lines
    }
    void prefetch_corner(std::uint32_t corner) const {
        prefetch(mesh_.faces.data()->data() + corner);
        prefetch(twin_.data() + corner);
    }

private:
    ProgressiveMesh() = default;

    /// The corners of the fan that moves and one more, as refine(split, corners) has them, in fan_.
    [[nodiscard]] Status find_fan(const VertexSplit& split);
    [[nodiscard]] bool is_beside_ghosts(const VertexSplit& split, const std::uint32_t* corners) const;
    [[nodiscard]] Status check(const VertexSplit& split);
    [[nodiscard]] Status check(EdgeFlip flip) const;
    [[nodiscard]] Status check(const VertexMove& move) const;
    [[nodiscard]] bool is_ghost(std::uint32_t vertex) const { return vertex < ghosts_; }
    [[nodiscard]] bool has_valence_of(std::uint32_t least, std::uint32_t corner) const;
    [[nodiscard]] bool are_joined(std::uint32_t corner, std::uint32_t other) const;

    void apply(const VertexSplit& split) { apply(split, fan_.data()); }
    void apply(const VertexSplit& split, const std::uint32_t* corners);
    void apply(EdgeFlip flip);
    void apply(const VertexMove& move);
    template <class AnyRecord>
    [[nodiscard]] Status take(const AnyRecord& record);
    /// What is wrong with a record that check found wrong.
    template <class AnyRecord>
    [[nodiscard]] Status refuse(const AnyRecord& record);

    void note_corners_beside(std::uint32_t half_edge);

    [[nodiscard]] VertexSplit last_split() const;
    void undo_split();
    void undo_last();

    TriangleMesh mesh_;
    std::vector<std::uint32_t> twin_;       // of half-edge 3f + c, which leaves corner c of face f along it
    std::vector<std::uint32_t> corner_of_;  // of each vertex
    std::uint32_t ghosts_ = 0;
    std::size_t level_ = 0;
    std::vector<std::uint32_t> border_splits_;
    std::vector<std::uint32_t> fan_;  // of the split that was checked last
    // What undoing takes; the records themselves are not kept.
    std::vector<RecordKind> applied_;
    std::vector<std::uint32_t> edited_;  // half-edge of each flip, vertex of each move
    std::vector<Vec3> lay_;              // where the vertex of each split and move lay before
};

/// What is visible of `mesh`, which stands at some record of `mrr`, with the regions and sets of `mrr`. O(faces).
[[nodiscard]] TriangleMesh visible_of(const ProgressiveMesh& mesh, const MultiresMesh& mrr);

/// What is visible of `mrr` at a level (clamped to the last). O(records). \pre `mrr` was made by this library (asserts
/// otherwise).
[[nodiscard]] TriangleMesh mesh_at(const MultiresMesh& mrr, std::size_t level);

}  // namespace vsplit

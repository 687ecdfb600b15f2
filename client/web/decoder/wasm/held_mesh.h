#pragma once

#include <cstdint>
#include <vector>

#include "marks.h"
#include "vsplit/mrr/progressive_mesh.h"
#include "vsplit/mrr/record_codec.h"

namespace vsplit::web {

/// A ProgressiveMesh that goes up again without a stream, for it keeps what it undid; and that tells what changed in it.
class HeldMesh {
public:
    explicit HeldMesh(ProgressiveMesh mesh) : mesh_(std::move(mesh)) {}

    [[nodiscard]] const ProgressiveMesh& mesh() const { return mesh_; }
    /// Records that `coarsen` undid.
    [[nodiscard]] std::size_t undone() const { return undone_.size(); }

    /// As ProgressiveMesh::foresee.
    void foresee(std::uint32_t splits) { mesh_.foresee(splits); }

    /// Brings back all records that were undone, then takes those of `block`. \return as RecordCodec::decode.
    [[nodiscard]] Status append(RecordCodec& codec, const RecordBlock& block);

    /// As ProgressiveMesh::coarsen; the records are kept.
    void coarsen(std::size_t levels);
    /// Applies kept records up to the split that makes `level`; all where there is none.
    void refine(std::size_t level);
    /// As ProgressiveMesh::rewind; the records go, and those that were undone before.
    void rewind(std::size_t records);

    /// From now on changes are noted, which takes its time.
    void follow() { follows_ = true; }
    /// Faces with a vertex that moved or whose ring changed since it was asked last, ascending; those that are gone left out.
    /// O(changes + mesh / 64).
    [[nodiscard]] const std::vector<std::uint32_t>& take_changes();

private:
    void undo();
    void redo();
    /// The vertices that a record is about. \pre the mesh stands before it.
    void note(const VertexSplit& split);
    void note(EdgeFlip flip);
    void note(const VertexMove& move) { vertices_.add(move.vertex); }

    ProgressiveMesh mesh_;
    std::vector<Record> undone_;  // the one undone last to be had back first
    bool follows_ = false;
    Marks vertices_, faces_;
    std::vector<std::uint32_t> changes_;
};

}  // namespace vsplit::web

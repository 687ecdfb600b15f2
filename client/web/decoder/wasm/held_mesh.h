#pragma once

#include <cstdint>
#include <vector>

#include "marks.h"
#include "vsplit/mrr/progressive_mesh.h"
#include "vsplit/mrr/record_codec.h"

namespace vsplit::web {

/// A ProgressiveMesh with the records that made it, so that it goes up again without a stream, and with what changed in it.
class HeldMesh {
public:
    explicit HeldMesh(ProgressiveMesh mesh) : mesh_(std::move(mesh)) {}

    [[nodiscard]] const ProgressiveMesh& mesh() const { return mesh_; }
    /// Records that have come; those that `coarsen` undid are among them.
    [[nodiscard]] const RecordList& records() const { return records_; }

    /// As ProgressiveMesh::foresee.
    void foresee(std::uint32_t splits);

    /// Brings back all records that were undone, then takes those of `block`. \return as RecordCodec::decode.
    [[nodiscard]] Status append(RecordCodec& codec, const RecordBlock& block);

    /// As ProgressiveMesh::coarsen; the records are kept.
    void coarsen(std::uint32_t levels);
    /// Applies kept records up to the split that makes `level`; all where there is none.
    void refine(std::uint32_t level);
    /// As ProgressiveMesh::rewind; the records go.
    void rewind(std::uint32_t records);

    /// From now on changes are noted, which takes its time.
    void follow() { follows_ = true; }
    /// Faces with a vertex that moved or whose ring changed since it was asked last, ascending; those that are gone left out.
    /// O(changes + mesh / 64).
    [[nodiscard]] const std::vector<std::uint32_t>& take_changes();

private:
    void apply_to(std::size_t records);
    void undo_to(std::size_t records);
    /// The vertices that a record is about. \pre the mesh stands before it.
    void note(const VertexSplit& split);
    void note(EdgeFlip flip);
    void note(const VertexMove& move) { vertices_.add(move.vertex); }

    ProgressiveMesh mesh_;
    RecordList records_;
    bool follows_ = false;
    Marks vertices_, faces_;
    std::vector<std::uint32_t> changes_;
};

}  // namespace vsplit::web

#pragma once

#include <cstddef>
#include <memory>

#include "vsplit/base/expected.h"
#include "vsplit/mrr/position_grid.h"
#include "vsplit/mrr/progressive_mesh.h"
#include "vsplit/mrr/record_block.h"

namespace vsplit {

/// Records into blocks and back, in any encoding, beside a mesh that goes along: both ends hold the mesh that a block's first
/// record is applied to, and records are coded relative to it.
///
///     RecordCodec codec(grid);
///     auto mesh = ProgressiveMesh::from_base(on_grid(mrr, grid).base, mrr.ghosts);
///     while (mesh->records() < mrr.records.size()) {
///         auto block = codec.encode(mrr.records, mesh->records(), mrr.records.size(), *mesh);
///         send(*block);                       // there: codec.decode(block, mesh, &records)
///     }
///
/// Keeps scratch memory, about three blocks. Not thread-safe; distinct objects are independent.
class RecordCodec {
public:
    explicit RecordCodec(const PositionGrid& grid = {});
    RecordCodec(RecordCodec&&) noexcept;
    RecordCodec& operator=(RecordCodec&&) noexcept;
    RecordCodec(const RecordCodec&) = delete;
    RecordCodec& operator=(const RecordCodec&) = delete;
    ~RecordCodec();

    [[nodiscard]] const PositionGrid& grid() const;

    /// As many of records [first, last) as fit one block, their positions rounded to the grid; `mesh`, which stands before record
    /// `first` and is rounded too, takes them. \pre first < last, last <= records.size(). \return CORRUPT, as
    /// ProgressiveMesh::refine, when a record does not fit the mesh. O(records * ring).
    [[nodiscard]] Expected<RecordBlock> encode(const RecordList& records, std::size_t first, std::size_t last,
                                               ProgressiveMesh& mesh);

    /// The way back: `mesh`, which stands where the block begins, takes its records; they are appended to `records` unless that
    /// is null. \return CORRUPT naming the block by its first record; `mesh` and `records` then are as they were before.
    [[nodiscard]] Status decode(const RecordBlock& block, ProgressiveMesh& mesh, RecordList* records = nullptr);

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// A block has at most so many records, in any encoding but kFloat64.
inline constexpr std::uint32_t kMaxBlockRecords = 1U << 16U;

}  // namespace vsplit

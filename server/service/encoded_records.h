#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>

#include "vsplit/mrr/record_codec.h"

namespace vsplit::service {

/// A base mesh, rounded and packed (pack_base).
struct EncodedBase {
    std::string bytes;
    double max_error = 0;  ///< of any coordinate of base mesh and records, model units
};

/// The base mesh, made once for all readers, and the records of an MRR in one encoding, as blocks: those that begin where blocks
/// usually begin are made once, for all readers; others, for readers that stand elsewhere, each time. Thread-safe; one block is
/// made at a time.
class EncodedRecords {
public:
    using Block = std::shared_ptr<const RecordBlock>;

    /// \pre choice was checked and is not kFloat64; `box` is box_of_all(mrr); `mrr` outlives this. O(1).
    EncodedRecords(const MultiresMesh& mrr, const BoundingBox& box, const EncodingChoice& choice);

    [[nodiscard]] const PositionGrid& grid() const { return grid_; }

    /// Heavy the first time: O(records).
    [[nodiscard]] std::shared_ptr<const EncodedBase> base();

    /// A block that begins at record `first` and ends at `last` at the latest, if it has been made. O(log(blocks)).
    [[nodiscard]] Block find(std::size_t first, std::size_t last) const;

    /// The same, made if need be. Heavy: O(records between the block before it and this one + its records).
    [[nodiscard]] Expected<Block> find_or_make(std::size_t first, std::size_t last);

private:
    [[nodiscard]] Block find_locked(std::size_t first, std::size_t last) const;
    [[nodiscard]] TriangleMesh rounded_base() const;
    [[nodiscard]] Status move_to(std::size_t record);

    const MultiresMesh& mrr_;
    const PositionGrid grid_;
    mutable std::mutex mutex_;  // of the blocks
    std::mutex making_;         // of what makes them; taken first
    std::once_flag base_made_;
    std::shared_ptr<const EncodedBase> base_;
    std::map<std::size_t, Block> blocks_;  // by first record
    std::set<std::size_t> begins_;         // where blocks usually begin, beside the multiples
    RecordCodec codec_;
    std::optional<ProgressiveMesh> mesh_;  // rounded; stands where the last block ended
};

}  // namespace vsplit::service

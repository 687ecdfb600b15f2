#pragma once

#include <cstddef>
#include <memory>

#include "service/encoded_records.h"
#include "service/lru_cache.h"
#include "service/memory_budget.h"
#include "vsplit/mesh/triangle_mesh.h"
#include "vsplit/mrr/multires_mesh.h"
#include "vsplit/quality/mesh_quality.h"

namespace vsplit::service {

/// A value and the memory it takes.
template <class Value>
struct Paid {
    Value value;
    MemoryBudget::Share share;
};

/// The resolutions of a representation, for its readers, who share it without waiting. The meshes, figures and encodings asked
/// for last are kept where memory has room for them. Thread-safe.
class Levels {
public:
    /// `budget` outlives this. O(records).
    Levels(MultiresMesh mrr, MemoryBudget& budget);

    [[nodiscard]] const MultiresMesh& mrr() const { return mrr_; }

    /// Heavy unless cached: O(records up to it). \pre level <= mrr().levels().
    [[nodiscard]] std::shared_ptr<const TriangleMesh> mesh(std::size_t level) const;

    /// Its figures. Heavy unless cached: O(faces log faces), and the mesh.
    [[nodiscard]] std::shared_ptr<const Quality> quality(std::size_t level) const;

    /// The records in an encoding. Heavy unless kept: O(records). It lives as long as this does. \pre as for EncodedRecords.
    [[nodiscard]] std::shared_ptr<EncodedRecords> encoded(const EncodingChoice& choice) const;

private:
    const MultiresMesh mrr_;
    const BoundingBox box_;  // of all positions: every quantised stream begins with it
    MemoryBudget& budget_;
    mutable LruCache<Paid<TriangleMesh>> meshes_;
    mutable LruCache<Quality> qualities_;
    mutable LruCache<Paid<std::shared_ptr<EncodedRecords>>> encoded_;
};

}  // namespace vsplit::service

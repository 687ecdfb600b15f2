#include "mesh/exact_merger.h"

#include <array>
#include <cassert>

namespace vsplit {

void ExactMerger::merge(const Vec3* points, std::size_t count, Vec3* kept, std::uint32_t* numbers) {
    assert(count <= kBatch);
    table_.reserve(kept_count_ + count);
    // Three passes, each asking the memory for what the next one needs.
    std::array<std::uint32_t, kBatch> hashes;
    for (std::size_t i = 0; i < count; ++i) {
        hashes[i] = hash_(points[i]);
        table_.prefetch(hashes[i]);
    }
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint32_t guess = table_.guess(hashes[i]);
        if (guess != IndexTable::kNone) __builtin_prefetch(&kept[guess]);
    }
    for (std::size_t i = 0; i < count; ++i) {
        const Vec3 point = points[i];
        numbers[i] = table_.find(hashes[i], [&](std::uint32_t index) { return kept[index] == point; });
        if (numbers[i] != IndexTable::kNone) continue;
        numbers[i] = kept_count_++;
        kept[numbers[i]] = point;
        table_.insert(hashes[i], numbers[i]);
    }
}

}  // namespace vsplit

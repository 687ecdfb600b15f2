#include "io/vertex_soup.h"

#include <algorithm>

namespace vsplit {

void VertexSoup::merge_waiting() {
    const std::size_t needed = merger_.kept_count() + ExactMerger::kBatch;
    if (kept_.size() < needed) kept_.resize(std::max(needed, 2 * kept_.size()));
    std::array<std::uint32_t, ExactMerger::kBatch> numbers;
    merger_.merge(waiting_.data(), waiting_count_, kept_.data(), numbers.data());
    for (std::size_t corner = 0; corner < waiting_count_; corner += 3) {
        faces_.push_back({numbers[corner], numbers[corner + 1], numbers[corner + 2]});
    }
    waiting_count_ = 0;
}

TriangleMesh VertexSoup::take() {
    merge_waiting();
    kept_.resize(merger_.kept_count());
    return {std::move(kept_), std::move(faces_)};
}

}  // namespace vsplit

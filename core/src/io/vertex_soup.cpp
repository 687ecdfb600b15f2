#include "io/vertex_soup.h"

#include <algorithm>

#include "base/huge_pages.h"

namespace vsplit {

void VertexSoup::reserve_faces(std::size_t faces) {
    const std::size_t vertices = faces / 2 + ExactMerger::kBatch;  // of a closed mesh
    reserve_large(faces_, faces);
    reserve_large(kept_, vertices);
    merger_.reserve(vertices);
}

void VertexSoup::merge_waiting() {
    const std::size_t needed = merger_.kept_count() + ExactMerger::kBatch;
    if (kept_.size() < needed) {
        reserve_large(kept_, std::max(needed, 2 * kept_.size()));
        kept_.resize(kept_.capacity());
    }
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

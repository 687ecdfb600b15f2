#include "service/encoded_records.h"

#include <algorithm>

#include "vsplit/mrr/base_codec.h"

namespace vsplit::service {
namespace {

/// Blocks usually begin at multiples of it; no reader gets one across, so that the next finds them.
constexpr std::size_t kUsual = 32768;

/// But the first is short, for it keeps a reader waiting. It makes a stream of 30,000 records a few parts in a thousand longer.
constexpr std::size_t kFirst = 4096;

/// Records that are rounded and applied at once.
constexpr std::size_t kStride = 4096;

std::size_t usual_end_of(std::size_t record) { return record < kFirst ? kFirst : (record / kUsual + 1) * kUsual; }
bool usually_begins_at(std::size_t record) { return record == kFirst || record % kUsual == 0; }

}  // namespace

EncodedRecords::EncodedRecords(const MultiresMesh& mrr, const BoundingBox& box, const EncodingChoice& choice)
    : mrr_(mrr), grid_(*PositionGrid::over(box, choice)), codec_(grid_) {}

std::shared_ptr<const EncodedBase> EncodedRecords::base() {
    std::call_once(base_made_, [this] {
        double largest = 0;
        for_each_position(mrr_, [&largest](const Vec3& p) { largest = std::max(largest, p.cwiseAbs().maxCoeff()); });
        base_ = std::make_shared<const EncodedBase>(
            EncodedBase{pack_base(rounded_base(), mrr_.ghosts, grid_), grid_.max_error(largest)});
    });
    return base_;
}

EncodedRecords::Block EncodedRecords::find(std::size_t first, std::size_t last) const {
    const std::lock_guard lock(mutex_);
    return find_locked(first, last);
}

EncodedRecords::Block EncodedRecords::find_locked(std::size_t first, std::size_t last) const {
    const auto found = blocks_.find(first);
    return found != blocks_.end() && first + found->second->count <= last ? found->second : nullptr;
}

Expected<EncodedRecords::Block> EncodedRecords::find_or_make(std::size_t first, std::size_t last) {
    const std::lock_guard making(making_);
    if (Block found = find(first, last)) return found;
    if (Status moved = move_to(first); !moved) return moved.error();
    const std::size_t usual_end = std::min(usual_end_of(first), mrr_.records.size());
    Expected<RecordBlock> made = codec_.encode(mrr_.records, first, std::min(last, usual_end), *mesh_);
    if (!made) return made.error();
    Block block = std::make_shared<const RecordBlock>(*std::move(made));
    const std::lock_guard lock(mutex_);
    if (last >= usual_end && (usually_begins_at(first) || begins_.contains(first))) {
        blocks_.emplace(first, block);
        begins_.insert(first + block->count);
    }
    return block;
}

TriangleMesh EncodedRecords::rounded_base() const {
    TriangleMesh base = mrr_.base;
    for (Vec3& position : base.positions) position = grid_.snap(position);
    return base;
}

Status EncodedRecords::move_to(std::size_t record) {
    if (!mesh_) {
        Expected<ProgressiveMesh> mesh = ProgressiveMesh::from_base(rounded_base(), mrr_.ghosts);
        if (!mesh) return mesh.error();
        mesh_ = *std::move(mesh);
    }
    mesh_->rewind(record);
    while (mesh_->records() < record) {
        const std::size_t count = std::min(kStride, record - mesh_->records());
        const RecordList rounded = on_grid(mrr_.records.slice(mesh_->records(), count), grid_);
        if (Status refined = mesh_->refine(rounded); !refined) return refined;
    }
    return Done{};
}

}  // namespace vsplit::service

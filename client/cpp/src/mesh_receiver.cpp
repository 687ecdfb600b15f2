#include "vsplit/client/mesh_receiver.h"

#include <string>
#include <utility>

#include "wire/regions.h"

namespace vsplit::client {
namespace {

Error too_many(std::uint64_t faces, std::uint32_t limit) {
    return {Cause::kLimitExceeded, "the stream builds " + std::to_string(faces) + " faces; accepted are " + std::to_string(limit),
            ""};
}

}  // namespace

EventHandlers MeshReceiver::handlers(std::function<void(const v1::Progress&)> on_progress) {
    return {std::move(on_progress), [this](StreamBase base) { return begin(std::move(base)); },
            [this](const RecordBlock& block) { return append(block); },
            [this](const v1::Regions& part) { return take_regions(part); }};
}

Status MeshReceiver::begin(StreamBase base) {
    const std::uint32_t first = base.first_record;
    Before before;
    if (first != 0) before = on_keyframe() ? before_ : Before{held_, progressive_};
    if (Status begun = begin(std::move(base.mesh), base.ghosts); !begun) return begun;
    progressive_->foresee(base.splits);
    before_ = std::move(before);
    first_record_ = first;
    codec_ = RecordCodec(base.grid);
    max_error_ = base.max_error;
    return Done{};
}

Status MeshReceiver::begin(TriangleMesh base, std::uint32_t ghosts) {
    if (base.face_count() > max_faces_) return too_many(base.face_count(), max_faces_);
    Expected<ProgressiveMesh> mesh = ProgressiveMesh::from_base(base, ghosts);
    if (!mesh) return mesh.error();
    const std::uint32_t ghost_faces = count_ghost_faces(base, ghosts);
    held_ = {std::move(base), {}, ghosts, ghost_faces, {}};
    progressive_ = *std::move(mesh);
    first_record_ = 0;
    has_regions_ = false;
    before_ = {};
    visible_records_.reset();
    codec_ = RecordCodec();
    max_error_ = 0;
    return Done{};
}

void MeshReceiver::leave_keyframe() {
    held_ = std::move(before_.held);
    progressive_ = std::move(before_.progressive);
    before_ = {};
    first_record_ = 0;
    has_regions_ = has_mesh();
    visible_records_.reset();
}

Status MeshReceiver::check_place(std::uint32_t first) {
    if (!has_mesh()) return Error{Cause::kOutOfOrder, "records came without a base mesh", ""};
    if (first == records_held()) {
        has_regions_ = true;
        return Done{};
    }
    return Error{Cause::kOutOfOrder,
                 "a block begins at record " + std::to_string(first) + ", expected is " + std::to_string(records_held()), ""};
}

Status MeshReceiver::append(const RecordBlock& block) {
    if (Status placed = check_place(block.first); !placed) return placed;
    const std::size_t before = held_.records.size();
    if (Status shown = show_records(before); !shown) return shown;
    if (Status decoded = codec_.decode(block, *progressive_, &held_.records); !decoded) return decoded;
    if (const std::uint32_t faces = progressive_->mesh().face_count(); faces > max_faces_) {
        progressive_->rewind(before);
        held_.records.truncate(before);
        return too_many(faces, max_faces_);
    }
    held_.border_splits = progressive_->border_splits();
    return Done{};
}

Status MeshReceiver::take_regions(const v1::Regions& part) {
    if (!has_mesh()) return Error{Cause::kOutOfOrder, "regions came without a base mesh", ""};
    if (part.faces() > max_faces_) return too_many(part.faces(), max_faces_);
    visible_records_.reset();
    return wire::add_regions(part, held_);
}

Status MeshReceiver::append(std::uint32_t first, const RecordSpan& records) {
    if (Status placed = check_place(first); !placed) return placed;
    const std::uint64_t faces = held_.base.face_count() + 2 * (std::uint64_t{held_.levels()} + records.splits.size());
    if (faces > max_faces_) return too_many(faces, max_faces_);
    if (Status shown = show_records(held_.records.size()); !shown) return shown;
    if (Status refined = progressive_->refine(records); !refined) {
        progressive_->rewind(held_.records.size());  // what is shown is always held
        return refined;
    }
    held_.records.append(records);
    held_.border_splits = progressive_->border_splits();
    return Done{};
}

Status MeshReceiver::show(std::uint32_t faces) {
    if (!has_mesh()) return Error{Cause::kOutOfOrder, "no mesh has been received yet", ""};
    return show_records(held_.record_of_level(held_.level_for(faces)));
}

const TriangleMesh& MeshReceiver::mesh() const {
    if (held_.ghosts == 0 && held_.regions.empty()) return progressive_->mesh();
    if (visible_records_ != progressive_->records()) {
        visible_ = visible_of(*progressive_, held_);
        visible_records_ = progressive_->records();
    }
    return visible_;
}

Status MeshReceiver::show_records(std::size_t records) {
    const std::size_t now = progressive_->records();
    if (records <= now) {
        progressive_->rewind(records);
        return Done{};
    }
    return progressive_->refine(held_.records.slice(now, records - now));
}

}  // namespace vsplit::client

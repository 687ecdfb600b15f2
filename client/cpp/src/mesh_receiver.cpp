#include "vsplit/client/mesh_receiver.h"

#include <string>
#include <utility>

namespace vsplit::client {
namespace {

Error too_many(std::uint64_t faces, std::uint32_t limit) {
    return {Cause::kLimitExceeded, "the stream builds " + std::to_string(faces) + " faces; accepted are " + std::to_string(limit),
            ""};
}

}  // namespace

EventHandlers MeshReceiver::handlers(std::function<void(const v1::Progress&)> on_progress) {
    return {std::move(on_progress), [this](TriangleMesh base) { return begin(std::move(base)); },
            [this](std::uint32_t first, std::span<const VertexSplit> splits) { return append(first, splits); }};
}

Status MeshReceiver::begin(TriangleMesh base) {
    if (base.face_count() > max_faces_) return too_many(base.face_count(), max_faces_);
    Expected<ProgressiveMesh> mesh = ProgressiveMesh::from_base(base);
    if (!mesh) return mesh.error();
    held_ = {std::move(base), {}};
    progressive_ = *std::move(mesh);
    return Done{};
}

Status MeshReceiver::append(std::uint32_t first, std::span<const VertexSplit> splits) {
    if (!has_mesh()) return Error{Cause::kOutOfOrder, "records came without a base mesh", ""};
    if (first != held_.splits.size()) {
        return Error{Cause::kOutOfOrder,
                     "a block begins at split " + std::to_string(first) + ", expected is " + std::to_string(held_.splits.size()),
                     ""};
    }
    const std::uint64_t faces = std::uint64_t{held_.faces_max()} + 2 * splits.size();
    if (faces > max_faces_) return too_many(faces, max_faces_);
    if (Status shown = show_level(held_.splits.size()); !shown) return shown;
    if (Status refined = progressive_->refine(splits); !refined) {
        progressive_->coarsen(progressive_->level() - held_.splits.size());  // what is shown is always held
        return refined;
    }
    held_.splits.insert(held_.splits.end(), splits.begin(), splits.end());
    return Done{};
}

Status MeshReceiver::show(std::uint32_t faces) {
    if (!has_mesh()) return Error{Cause::kOutOfOrder, "no mesh has been received yet", ""};
    return show_level(held_.level_for(faces));
}

Status MeshReceiver::show_level(std::size_t level) {
    const std::size_t now = progressive_->level();
    if (level <= now) {
        progressive_->coarsen(now - level);
        return Done{};
    }
    return progressive_->refine(std::span(held_.splits).subspan(now, level - now));
}

}  // namespace vsplit::client

#include "event_stream.h"

#include <utility>

#include "vsplit/mrr/record_block.h"
#include "wire/convert.h"

namespace vsplit::client {

Status EventStream::take_base(const v1::BaseMesh& part) {
    if (!base_) base_.emplace();
    if (Status added = base_->add(part); !added) return added;
    if (!base_->complete() || !handlers_.on_base_mesh) return Done{};
    return handlers_.on_base_mesh(
        {base_->take(), base_->ghosts(), base_->grid(), base_->max_error(), base_->first_record(), base_->splits()});
}

Status EventStream::take_block(v1::RecordBlock message) {
    if (base_ && !base_->complete()) return Error{Cause::kOutOfOrder, "records came before the end of the base mesh", ""};
    if (!handlers_.on_block) return Done{};
    const Expected<RecordBlock> block = wire::from_proto(std::move(message));
    if (!block) return block.error();
    return handlers_.on_block(*block);
}

Status EventStream::take(v1::ProgressiveEvent event) {
    if (representation_) return Error{Cause::kOutOfOrder, "the server sent an event after the representation", ""};
    switch (event.event_case()) {
        case v1::ProgressiveEvent::kProgress:
            if (handlers_.on_progress) handlers_.on_progress(event.progress());
            return Done{};
        case v1::ProgressiveEvent::kBaseMesh:
            return take_base(event.base_mesh());
        case v1::ProgressiveEvent::kRecordBlock:
            return take_block(std::move(*event.mutable_record_block()));
        case v1::ProgressiveEvent::kRepresentation:
            representation_ = std::move(*event.mutable_representation());
            return Done{};
        case v1::ProgressiveEvent::kRegions:
            return handlers_.on_regions ? handlers_.on_regions(event.regions()) : Status(Done{});
        case v1::ProgressiveEvent::kError:  // over HTTP only
        case v1::ProgressiveEvent::EVENT_NOT_SET:
            return Done{};  // a kind of a later version
    }
    return Done{};
}

Expected<v1::Representation> EventStream::finish() {
    if (base_ && !base_->complete()) return Error{Cause::kCorrupt, "the server's stream ended within the base mesh", ""};
    if (!representation_) return Error{Cause::kCorrupt, "the server's stream ended without a representation", ""};
    return *std::move(representation_);
}

}  // namespace vsplit::client

#include "grpc/level_stream.h"

#include <algorithm>
#include <utility>

#include "grpc/replies.h"
#include "service/guarded.h"
#include "wire/base_mesh.h"
#include "wire/convert.h"
#include "wire/error_table.h"
#include "wire/regions.h"

namespace vsplit::rpc {

LevelParts::LevelParts(service::ResolutionPlan plan, RecordEncoding encoding)
    : plan_(std::move(plan)),
      encoding_(encoding),
      base_parts_(plan_.with_base ? wire::base_mesh_parts(plan_.representation->mrr().base) : 0),
      region_parts_(plan_.with_base ? wire::region_parts(plan_.representation->mrr()) : 0),
      record_(plan_.first_record) {}

bool LevelParts::next(v1::ProgressiveEvent& event) {
    if (base_part_ < base_parts_) {
        const MultiresMesh& mrr = plan_.representation->mrr();
        *event.mutable_base_mesh() = wire::base_mesh_part(mrr.base, base_part_++, mrr.ghosts);
        return true;
    }
    if (region_part_ < region_parts_) {
        *event.mutable_regions() = wire::region_part(plan_.representation->mrr(), region_part_++);
        return true;
    }
    if (record_ == plan_.last_record) return false;
    next_block(event);
    return true;
}

void LevelParts::next_block(v1::ProgressiveEvent& event) {
    const RecordList& records = plan_.representation->mrr().records;
    // No record of any encoding takes less than a byte of its block.
    const std::size_t most = std::min(kMaxBlockBytes, plan_.last_record - record_);
    const std::size_t count = records_that_fit(records.slice(record_, most), encoding_);
    *event.mutable_record_block() =
        wire::to_proto(encode_block(records.slice(record_, count), static_cast<std::uint32_t>(record_), encoding_));
    record_ += count;
}

Expected<std::unique_ptr<MessageSource<v1::ProgressiveEvent>>> LevelSource::make(service::MeshingService& service,
                                                                                 const v1::SetResolutionRequest& request,
                                                                                 const Wake& wake) {
    const Expected<RecordEncoding> encoding = wire::from_proto(request.encoding());
    if (!encoding) return encoding.error();
    const Expected<service::SessionSnapshot> session = service.snapshot(request.session());
    if (!session) return session.error();
    Expected<service::ResolutionPlan> plan = service::plan_resolution(
        *session, {request.representation(), request.faces_held(), request.faces(), request.resume_from()});
    if (!plan) return plan.error();
    auto last = std::make_shared<Last>();
    const bool taken = service.errand([last, wake, representation = plan->representation, level = plan->level] {
        last->put(service::guarded([&]() -> Expected<v1::Representation> { return to_proto(*representation, level); }));
        wake();
    });
    if (!taken) return Error{Cause::kUnavailable, "the server is shutting down", ""};
    return std::unique_ptr<MessageSource>(new LevelSource(LevelParts(*std::move(plan), *encoding), std::move(last)));
}

LevelSource::Step LevelSource::next(v1::ProgressiveEvent& event, grpc::Status& end) {
    if (ended_) return Step::kEnd;
    if (parts_.next(event)) return Step::kMessage;
    std::optional<Expected<v1::Representation>> last = last_->take();
    if (!last) return Step::kWait;
    ended_ = true;
    if (*last) {
        *event.mutable_representation() = **std::move(last);
        return Step::kMessage;
    }
    end = wire::to_status(last->error());
    return Step::kEnd;
}

}  // namespace vsplit::rpc

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

LevelParts::LevelParts(service::MeshingService& service, service::ResolutionPlan plan, const EncodingChoice& choice, Wake wake)
    : service_(&service), plan_(std::move(plan)), choice_(choice), wake_(std::move(wake)), record_(plan_.first_record) {
    if (!plan_.with_base) return;
    region_parts_ = wire::region_parts(plan_.levels->mrr());
    const bool plain = choice_.encoding == RecordEncoding::kFloat64;
    if (plain) base_parts_ = wire::base_mesh_parts(plain_base());
}

Expected<LevelParts::Step> LevelParts::next(v1::ProgressiveEvent& event) {
    if (choice_.encoding == RecordEncoding::kFloat64) return next_plain(event) ? Step::kMessage : Step::kEnd;
    if (Status taken = take_made(); !taken) return taken.error();
    if (made_.base && base_part_ < wire::base_mesh_parts(*made_.base)) {
        send(wire::base_mesh_part(*made_.base, base_part_++), event);
        if (Status begun = make_block(); !begun) return begun.error();
        return Step::kMessage;
    }
    const bool ready = made_.encoded != nullptr;
    if (ready && next_regions(event)) return Step::kMessage;
    if (ready && record_ == plan_.last_record) return Step::kEnd;
    if (Status begun = make_block(); !begun) return begun.error();
    if (!made_.block) return Step::kWait;
    send(*std::exchange(made_.block, nullptr), event);
    if (Status begun = make_block(); !begun) return begun.error();  // while this one is on its way
    return Step::kMessage;
}

/// What comes next, if it is not here: the block that is found, or an errand.
Status LevelParts::make_block() {
    if (waiting_ || made_.block || (made_.encoded && record_ == plan_.last_record)) return Done{};
    if (made_.encoded) made_.block = made_.encoded->find(record_, plan_.last_record);
    return made_.block ? Status(Done{}) : begin_errand();
}

void LevelParts::send(v1::BaseMesh part, v1::ProgressiveEvent& event) const {
    if (plan_.keyframe) {
        part.set_first_record(static_cast<std::uint32_t>(plan_.first_record));
    } else {
        part.set_splits(static_cast<std::uint32_t>(plan_.level));
    }
    *event.mutable_base_mesh() = std::move(part);
}

void LevelParts::send(RecordBlock block, v1::ProgressiveEvent& event) {
    record_ += block.count;
    *event.mutable_record_block() = wire::to_proto(std::move(block));
}

Status LevelParts::take_made() {
    std::optional<Expected<Made>> made = box_->take();
    if (!made) return Done{};
    waiting_ = false;
    if (!*made) return made->error();
    made_.encoded = (*made)->encoded;
    if ((*made)->base) made_.base = std::move((*made)->base);
    made_.block = std::move((*made)->block);
    return Done{};
}

Status LevelParts::begin_errand() {
    waiting_ = true;
    const auto work = [weak_box = std::weak_ptr(box_), wake = wake_, levels = plan_.levels, choice = choice_,
                       encoded = made_.encoded, with_base = plan_.with_base, first = record_, last = plan_.last_record] {
        const std::shared_ptr<MadeBox> box = weak_box.lock();
        if (!box) return;  // nobody waits any more
        box->put(service::guarded([&]() -> Expected<Made> {
            Made made{encoded, {}, {}};
            if (!encoded) {
                made.encoded = levels->encoded(choice);
                if (with_base) {
                    const auto base = made.encoded->base();
                    made.base = wire::packed_base_mesh(levels->mrr(), made.encoded->grid(), base->bytes, base->max_error);
                }
            }
            if (made.base || first == last) return made;  // the base mesh leaves before the first block is made
            Expected<service::EncodedRecords::Block> block = made.encoded->find_or_make(first, last);
            if (!block) return block.error();
            made.block = *std::move(block);
            return made;
        }));
        wake();
    };
    if (service_->errand(work)) return Done{};
    return Error{Cause::kUnavailable, "the server is shutting down", ""};
}

/// After the base mesh and before records.
bool LevelParts::next_regions(v1::ProgressiveEvent& event) {
    if (region_part_ == region_parts_) return false;
    *event.mutable_regions() = wire::region_part(plan_.levels->mrr(), region_part_++);
    return true;
}

bool LevelParts::next_plain(v1::ProgressiveEvent& event) {
    const MultiresMesh& mrr = plan_.levels->mrr();
    if (base_part_ < base_parts_) {
        send(wire::base_mesh_part(plain_base(), base_part_++, mrr.ghosts), event);
        return true;
    }
    if (next_regions(event)) return true;
    if (record_ == plan_.last_record) return false;
    // No record of any encoding takes less than a byte of its block.
    const std::size_t most = std::min(kMaxBlockBytes, plan_.last_record - record_);
    const std::size_t count = records_that_fit(mrr.records.slice(record_, most), choice_.encoding);
    std::string memory;  // that of the block before, which is on its way
    if (event.has_record_block()) memory = std::move(*event.mutable_record_block()->mutable_payload());
    send(
        encode_block(mrr.records.slice(record_, count), static_cast<std::uint32_t>(record_), choice_.encoding, std::move(memory)),
        event);
    return true;
}

Expected<std::unique_ptr<MessageSource<v1::ProgressiveEvent>>> LevelSource::make(service::MeshingService& service,
                                                                                 const service::Caller& caller,
                                                                                 const v1::SetResolutionRequest& request,
                                                                                 const Wake& wake) {
    const Expected<EncodingChoice> choice = wire::encoding_of(request);
    if (!choice) return choice.error();
    const Expected<service::SessionSnapshot> session = service.snapshot(request.session(), caller);
    if (!session) return session.error();
    const service::ResolutionRequest wanted{request.representation(), request.faces_held(), request.faces(),
                                            request.resume_from(),
                                            request.keyframe() && choice->encoding == RecordEncoding::kFloat64};
    const auto representation = service::find_requested(*session, wanted);
    if (!representation) return representation.error();
    auto news = std::make_shared<News>();
    const bool taken = service.errand([weak_news = std::weak_ptr(news), wake, wanted, representation = *representation] {
        const std::shared_ptr<News> told = weak_news.lock();
        if (!told) return;  // nobody waits any more
        Expected<service::ResolutionPlan> plan =
            service::guarded([&] { return service::plan_resolution(representation, wanted); });
        const bool found = plan.has_value();
        const service::ResolutionPlan kept = found ? *plan : service::ResolutionPlan();
        told->plan.put(std::move(plan));
        wake();
        if (!found || told.use_count() == 1) return;
        told->last.put(service::guarded(
            [&]() -> Expected<v1::Representation> { return to_proto(*representation, *kept.levels, kept.level); }));
        wake();
    });
    if (!taken) return Error{Cause::kUnavailable, "the server is shutting down", ""};
    return std::unique_ptr<MessageSource>(new LevelSource(service, *choice, wake, std::move(news)));
}

LevelSource::Step LevelSource::next(v1::ProgressiveEvent& event, grpc::Status& end) {
    const Expected<Step> step = next_or_error(event);
    if (step) return *step;
    end = wire::to_status(step.error());
    return Step::kEnd;
}

Expected<LevelSource::Step> LevelSource::next_or_error(v1::ProgressiveEvent& event) {
    if (ended_) return Step::kEnd;
    if (!parts_) {
        std::optional<Expected<service::ResolutionPlan>> plan = news_->plan.take();
        if (!plan) return Step::kWait;
        if (!*plan) return plan->error();
        parts_.emplace(service_, **std::move(plan), choice_, wake_);
    }
    Expected<Step> step = parts_->next(event);
    if (!step || *step != Step::kEnd) return step;
    std::optional<Expected<v1::Representation>> last = news_->last.take();
    if (!last) return Step::kWait;
    if (!*last) return last->error();
    ended_ = true;
    *event.mutable_representation() = **std::move(last);
    return Step::kMessage;
}

}  // namespace vsplit::rpc

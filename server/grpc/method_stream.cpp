#include "grpc/method_stream.h"

#include <utility>

#include "grpc/replies.h"
#include "wire/convert.h"
#include "wire/error_table.h"

namespace vsplit::rpc {

using EventSourcePointer = std::unique_ptr<MessageSource<v1::ProgressiveEvent>>;

Expected<EventSourcePointer> MethodSource::make(service::MeshingService& service, const service::Caller& caller,
                                                const v1::ImproveRequest& request, const Wake& wake) {
    return begin(service, caller, request, wake);
}

Expected<EventSourcePointer> MethodSource::make(service::MeshingService& service, const service::Caller& caller,
                                                const v1::ControlRequest& request, const Wake& wake) {
    return begin(service, caller, request, wake);
}

template <class Request>
Expected<EventSourcePointer> MethodSource::begin(service::MeshingService& service, const service::Caller& caller,
                                                 const Request& request, const Wake& wake) {
    const auto options = wire::from_proto(request.options());
    if (!options) return options.error();
    const Expected<EncodingChoice> choice = wire::encoding_of(request);
    if (!choice) return choice.error();
    auto news = std::make_shared<News>();
    service::JobEvents events;
    events.on_noted = [news, wake] {
        news->noted = true;
        wake();
    };
    events.on_progress = [news, wake](const Progress& progress) {
        news->progress.put(wire::to_proto(progress));
        wake();
    };
    events.on_done = [news, wake](const service::JobOutcome& outcome) {
        news->outcome.put(outcome);
        wake();
    };
    const service::MeshRef source{request.source().representation(), request.source().faces()};
    Expected<service::RunningMethod> running = service.start(request.session(), {source, *options}, std::move(events), caller);
    if (!running) return running.error();
    return EventSourcePointer(new MethodSource(service, *std::move(running), std::move(news), *choice, wake));
}

void MethodSource::cancel() {
    running_.session->cancel(running_.job, {Cause::kCancelled, "the client is gone or its deadline has passed", ""});
}

MethodSource::Step MethodSource::next(v1::ProgressiveEvent& event, grpc::Status& end) {
    if (ended_) return Step::kEnd;
    if (!begun_) {
        if (!news_->noted) return Step::kWait;
        begun_ = true;
        *event.mutable_progress() = wire::to_proto(Progress{"queued", 0, 0});
        return Step::kMessage;
    }
    return parts_ ? next_part(event, end) : next_news(event, end);
}

MethodSource::Step MethodSource::next_news(v1::ProgressiveEvent& event, grpc::Status& end) {
    // In this order: what is told of the progress was put there before the outcome.
    const std::optional<service::JobOutcome> outcome = news_->outcome.take();
    if (!outcome) {
        std::optional<v1::Progress> progress = news_->progress.take();
        if (!progress) return Step::kWait;
        *event.mutable_progress() = *std::move(progress);
        return Step::kMessage;
    }
    if (!*outcome) {
        end = wire::to_status(outcome->error());
        return Step::kEnd;
    }
    result_ = (*outcome)->representation;
    const std::uint32_t faces = result_->figures().faces;
    parts_.emplace(service_, service::plan_from_nothing(result_, (*outcome)->levels, faces), choice_, wake_);
    return next_part(event, end);
}

MethodSource::Step MethodSource::next_part(v1::ProgressiveEvent& event, grpc::Status& end) {
    const Expected<Step> step = parts_->next(event);
    if (!step) {
        end = wire::to_status(step.error());
        return Step::kEnd;
    }
    if (*step != Step::kEnd) return *step;
    ended_ = true;
    *event.mutable_representation() = to_proto(*result_);
    return Step::kMessage;
}

}  // namespace vsplit::rpc

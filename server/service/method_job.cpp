#include "service/method_job.h"

#include <utility>
#include <variant>

#include "service/guarded.h"
#include "vsplit/method/control.h"
#include "vsplit/method/improve.h"

namespace vsplit::service {

MethodJob::MethodJob(std::shared_ptr<Session> session, PickedMesh source, const MethodOptions& options,
                     const ServiceOptions& service, JobEvents events)
    : session_(std::move(session)),
      source_(std::move(source)),
      options_(options),
      limits_{service.limits.faces_subdivided},
      events_(std::move(events)),
      context_([this](const Progress& progress) { tell(progress); }, service.threads) {}

Job::Report MethodJob::run() {
    JobOutcome outcome = guarded([this] { return compute(); });
    if (const std::optional<Error> why = stopped(); why && !outcome) outcome = *why;
    return [this, outcome = std::move(outcome)] { events_.on_done(outcome); };
}

void MethodJob::stop(const Error& why) {
    {
        const std::lock_guard lock(mutex_);
        if (!why_stopped_) why_stopped_ = why;
    }
    context_.cancel();
}

void MethodJob::abandon(const Error& why) { events_.on_done(why); }

JobOutcome MethodJob::compute() {
    if (const std::optional<Error> why = stopped()) return *why;
    const std::shared_ptr<const TriangleMesh> mesh = source_.mesh();
    Expected<MethodResult> result = std::visit([&](const auto& options) { return apply(options, *mesh); }, options_);
    if (!result) return result.error();
    if (const std::optional<Error> why = stopped()) return *why;
    return session_->add_representation(source_.ref(), *std::move(result));
}

Expected<MethodResult> MethodJob::apply(const ImproveOptions& options, const TriangleMesh& mesh) {
    return improve(mesh, options, limits_, context_);
}

Expected<MethodResult> MethodJob::apply(const ControlOptions& options, const TriangleMesh& mesh) {
    return control(mesh, options, limits_, context_);
}

std::optional<Error> MethodJob::stopped() const {
    const std::lock_guard lock(mutex_);
    return why_stopped_;
}

void MethodJob::tell(const Progress& progress) {
    if (gate_.open(progress.stage, ProgressGate::Clock::now())) events_.on_progress(progress);
}

}  // namespace vsplit::service

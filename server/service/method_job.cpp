#include "service/method_job.h"

#include <utility>
#include <variant>

#include "service/guarded.h"
#include "vsplit/method/control.h"
#include "vsplit/method/improve.h"

namespace vsplit::service {

MethodJob::MethodJob(std::shared_ptr<Session> session, PickedMesh source, const MethodOptions& options,
                     const ServiceOptions& service, JobEvents events, const Caller& caller)
    : session_(std::move(session)),
      source_(std::move(source)),
      options_(options),
      limits_{service.limits.faces_subdivided},
      events_(std::move(events)),
      observer_(service.job_observer),
      request_id_(caller.request_id),
      context_([this](const Progress& progress) { tell(progress); }, service.threads) {}

Job::Report MethodJob::run() {
    const auto began = std::chrono::steady_clock::now();
    JobOutcome outcome = guarded([this] { return compute(); });
    if (const std::optional<Error> why = stopped(); why && !outcome) outcome = *why;
    if (observer_) record(outcome, began);
    return [this, outcome = std::move(outcome)] { events_.on_done(outcome); };
}

void MethodJob::record(const JobOutcome& outcome, std::chrono::steady_clock::time_point began) const {
    using Seconds = std::chrono::duration<double>;
    JobRecord record{std::holds_alternative<ImproveOptions>(options_) ? "Improve" : "Control"};
    record.session = session_->id();
    record.request_id = request_id_;
    record.waited = Seconds(began - asked_).count();
    record.seconds = Seconds(std::chrono::steady_clock::now() - began).count();
    record.faces_in = source_.faces();
    if (outcome) {
        record.faces_out = (*outcome)->result().faces;
    } else {
        record.outcome = outcome.error().cause;
    }
    observer_(record);
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

#include "service/method_job.h"

#include <algorithm>
#include <limits>
#include <string>
#include <utility>
#include <variant>

#include "service/bounded_work.h"
#include "service/guarded.h"
#include "service/memory_use.h"
#include "vsplit/method/control.h"
#include "vsplit/method/improve.h"

namespace vsplit::service {
MethodJob::MethodJob(std::shared_ptr<Session> session, PickedMesh source, MethodRequest request, const MethodHost& host,
                     std::shared_ptr<JobNote> note, JobEvents events, const Caller& caller)
    : session_(std::move(session)),
      source_(std::move(source)),
      request_(std::move(request)),
      host_(host),
      events_(std::move(events)),
      note_(std::move(note)),
      mark_(caller.mark),
      context_([this](const Progress& progress) { tell(progress); }, host.options.threads) {}

Job::Report MethodJob::run() {
    const auto began = std::chrono::steady_clock::now();
    context_.cancel_at(began + std::chrono::seconds(host_.options.limits.job_seconds));
    JobOutcome outcome = guarded([this] { return compute(); });
    if (!outcome && outcome.error().cause == Cause::kCancelled) outcome = why_cancelled();
    room_.give_back();
    end_note(outcome);
    if (host_.options.job_observer) record(outcome, began);
    return [this, outcome = std::move(outcome)] { events_.on_done(outcome); };
}

/// What the end of the server cuts off stays in the archive, to be told after the next start.
void MethodJob::end_note(const JobOutcome& outcome) const {
    if (!outcome && outcome.error().cause == Cause::kUnavailable) return;
    static_cast<void>(host_.disk.submit([note = note_] { note->erase(); }));
}

void MethodJob::record(const JobOutcome& outcome, std::chrono::steady_clock::time_point began) const {
    using Seconds = std::chrono::duration<double>;
    JobRecord record{std::holds_alternative<ImproveOptions>(request_.options) ? "Improve" : "Control"};
    record.session = session_->id();
    record.mark = mark_;
    record.waited = Seconds(began - asked_).count();
    record.seconds = Seconds(std::chrono::steady_clock::now() - began).count();
    record.faces_in = faces_in_;
    if (outcome) {
        record.faces_out = outcome->representation->figures().faces;
    } else {
        record.outcome = outcome.error().cause;
    }
    host_.options.job_observer(record);
}

void MethodJob::stop(const Error& why) {
    {
        const std::lock_guard lock(mutex_);
        if (!why_stopped_) why_stopped_ = why;
    }
    context_.cancel();
}

void MethodJob::abandon(const Error& why) {
    end_note(why);
    events_.on_done(why);
}

JobOutcome MethodJob::compute() {
    if (const std::optional<Error> why = stopped()) return *why;
    const Expected<OpenedMesh> source = source_.open();
    if (!source) return source.error();
    faces_in_ = source->ref.faces;
    const MethodRequest used{source->ref, request_.options};
    if (const auto before = session_->find_made(used)) {
        const Expected<std::shared_ptr<const Levels>> levels = before->levels().get();
        if (!levels) return levels.error();
        session_->answered(request_);
        return MadeRepresentation{before, *levels};
    }
    return make(used, *source->mesh);
}

JobOutcome MethodJob::make(const MethodRequest& request, const TriangleMesh& mesh) {
    if (Status room = session_->require_room(); !room) return room.error();
    if (Status room = make_room(mesh.face_count()); !room) return room.error();
    Expected<MethodResult> result = std::visit([&](const auto& options) { return apply(options, mesh); }, request.options);
    if (!result) return explained(result.error());
    if (const std::optional<Error> why = stopped()) return *why;
    result->unit = source_.unit();
    const auto made = session_->add_representation(request, *std::move(result));
    if (!made) return made.error();
    const Expected<std::shared_ptr<const Levels>> levels = (*made)->levels().get();
    if (!levels) return levels.error();
    session_->answered(request_);
    return MadeRepresentation{*made, *levels};
}

/// For a method on so many faces, in place of the room there was.
Status MethodJob::make_room(std::uint64_t faces) {
    room_.give_back();
    Expected<MemoryBudget::Share> room =
        host_.memory.reserve(memory_to_simplify(faces), "a method on " + std::to_string(faces) + " faces");
    if (!room) return room.error();
    room_ = *std::move(room);
    return Done{};
}

/// Faces that all the memory there may be would do for: to be known before subdivision takes any.
std::uint64_t MethodJob::faces_in_memory() const {
    const std::uint64_t bytes = host_.options.limits.memory_bytes;
    return bytes == 0 ? std::numeric_limits<std::uint32_t>::max() : bytes / memory_to_simplify(1);
}

MethodLimits MethodJob::limits() {
    const std::uint64_t most = std::min<std::uint64_t>(host_.options.limits.faces_subdivided, faces_in_memory());
    return {static_cast<std::uint32_t>(most), [this](std::uint32_t faces) { return make_room(faces); }};
}

/// With the server's limit by its name, where the method knows but a number.
Error MethodJob::explained(Error error) const {
    const Limits& limits = host_.options.limits;
    if (error.cause != Cause::kLimitExceeded || error.message.find("max_memory_bytes") != std::string::npos) return error;
    const bool by_memory = faces_in_memory() < limits.faces_subdivided;
    if (!by_memory && error.message.find(", the limit") == std::string::npos) return error;
    error.message += by_memory
                         ? "; the server's limit max_memory_bytes, " + std::to_string(limits.memory_bytes) + ", allows no more"
                         : "; the server's limit max_faces_subdivided is " + std::to_string(limits.faces_subdivided);
    return error;
}

Expected<MethodResult> MethodJob::apply(const ImproveOptions& options, const TriangleMesh& mesh) {
    return improve(mesh, options, limits(), context_);
}

Expected<MethodResult> MethodJob::apply(const ControlOptions& options, const TriangleMesh& mesh) {
    return control(mesh, options, limits(), context_);
}

std::optional<Error> MethodJob::stopped() const {
    const std::lock_guard lock(mutex_);
    return why_stopped_;
}

Error MethodJob::why_cancelled() const {
    if (const std::optional<Error> why = stopped()) return *why;
    return context_.late() ? took_too_long("the method", host_.options.limits) : ExecutionContext::cancelled_error();
}

void MethodJob::tell(const Progress& progress) {
    if (gate_.open(progress.stage, ProgressGate::Clock::now())) events_.on_progress(progress);
}

}  // namespace vsplit::service

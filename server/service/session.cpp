#include "service/session.h"

#include <utility>

namespace vsplit::service {

Session::Session(std::string id, std::uint64_t number, std::shared_ptr<const SourceMesh> source, const ServiceOptions& options,
                 WorkerPool& workers, std::string owner)
    : id_(std::move(id)),
      owner_(std::move(owner)),
      number_(number),
      options_(options),
      queue_(std::make_shared<JobQueue>(workers, options.limits.waiting_jobs)),
      expires_(Clock::now() + options.session_ttl),
      source_(std::move(source)) {}

SessionSnapshot Session::snapshot() const {
    const std::lock_guard lock(mutex_);
    return snapshot_locked();
}

// The steady clock decides, so that setting the machine's time deletes nothing; people are shown the system's.
SessionSnapshot Session::snapshot_locked() const {
    const auto left = std::chrono::duration_cast<std::chrono::system_clock::duration>(expires_ - Clock::now());
    return {id_, create_time_, std::chrono::system_clock::now() + left, source_, representations_};
}

void Session::touch() {
    const std::lock_guard lock(mutex_);
    expires_ = Clock::now() + options_.session_ttl;
}

bool Session::expired() const {
    const std::lock_guard lock(mutex_);
    return Clock::now() >= expires_ && queue_->idle();
}

Status Session::require_idle() const {
    const std::lock_guard lock(mutex_);
    return require_idle_locked();
}

Status Session::require_open_locked() const {
    if (closed_) return Error{Cause::kNotFound, "the session was deleted in the meantime", "session"};
    return Done{};
}

Status Session::require_idle_locked() const {
    if (Status open = require_open_locked(); !open) return open;
    if (queue_->idle()) return Done{};
    return Error{Cause::kBusy,
                 "a method runs or waits in this session; upload when it is done or cancelled, or into another session",
                 "session"};
}

Status Session::set_source(std::shared_ptr<const SourceMesh> source) {
    std::vector<SessionSnapshot::RepresentationPointer> dropped;  // freed after the lock is released
    const std::lock_guard lock(mutex_);
    return set_source_locked(source, dropped);
}

Status Session::replace_source(const std::shared_ptr<const SourceMesh>& before, std::shared_ptr<const SourceMesh> source) {
    std::vector<SessionSnapshot::RepresentationPointer> dropped;
    const std::lock_guard lock(mutex_);
    if (source_ != before) {
        return Error{Cause::kBusy, "the session got another mesh in the meantime; nothing was changed", "session", kRetryAfter};
    }
    return set_source_locked(source, dropped);
}

Status Session::set_source_locked(std::shared_ptr<const SourceMesh>& source,
                                  std::vector<SessionSnapshot::RepresentationPointer>& dropped) {
    if (Status idle = require_idle_locked(); !idle) return idle;
    source_.swap(source);
    representations_.swap(dropped);
    return Done{};
}

Expected<SessionSnapshot::RepresentationPointer> Session::add_representation(MeshRef source, MethodResult result) {
    const std::lock_guard lock(mutex_);
    if (Status open = require_open_locked(); !open) return open.error();
    auto made = std::make_shared<const Representation>('r' + std::to_string(++made_), std::move(source), std::move(result));
    representations_.push_back(made);
    expires_ = Clock::now() + options_.session_ttl;
    return SessionSnapshot::RepresentationPointer(std::move(made));
}

Expected<std::shared_ptr<Job>> Session::enqueue(const MakeJob& make) {
    const std::lock_guard lock(mutex_);
    if (Status open = require_open_locked(); !open) return open.error();
    const std::uint32_t limit = options_.limits.representations;
    if (representations_.size() >= limit) {
        return Error{Cause::kLimitExceeded,
                     "the session has " + std::to_string(limit) + " representations, the server's limit max_representations; " +
                         "upload the mesh again to drop them, or use another session",
                     "session"};
    }
    Expected<std::shared_ptr<Job>> job = make(snapshot_locked());
    if (!job) return job;
    if (Status pushed = queue_->push(*job); !pushed) return pushed.error();
    return job;
}

void Session::close(const Error& why) {
    {
        const std::lock_guard lock(mutex_);
        closed_ = true;
    }
    queue_->close(why);
}

}  // namespace vsplit::service

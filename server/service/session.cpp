#include "service/session.h"

#include <algorithm>
#include <utility>

#include "service/memory_use.h"

namespace vsplit::service {
namespace {

Error busy_uploading() {
    return {Cause::kBusy, "an uploaded mesh is just being put into this session; try again", "session", kRetryAfter};
}

}  // namespace

Session::Session(SessionRecord record, Clock::time_point began, const SessionHost& host)
    : id_(std::move(record.id)),
      owner_(std::move(record.owner)),
      number_(record.number),
      host_(host),
      create_time_(record.create_time),
      queue_(std::make_shared<JobQueue>(host.workers, host.options.limits.waiting_jobs)),
      expires_(record.expires ? began + *record.expires : Clock::now() + host.options.session_ttl),
      used_(!record.expires),
      source_(std::move(record.source)),
      representations_(std::move(record.representations)),
      unfinished_(std::move(record.unfinished)),
      made_(record.made) {}

SessionSnapshot Session::snapshot() const {
    const std::lock_guard lock(mutex_);
    return snapshot_locked();
}

// The steady clock decides, so that setting the machine's time deletes nothing; people are shown the system's.
SessionSnapshot Session::snapshot_locked() const {
    const auto left = std::chrono::duration_cast<std::chrono::system_clock::duration>(expires_ - Clock::now());
    SessionSnapshot snapshot{id_, create_time_, std::chrono::system_clock::now() + left, source_, representations_, {}};
    for (const UnfinishedMethod& method : unfinished_) snapshot.interrupted.push_back(method.request);
    return snapshot;
}

void Session::touch() {
    const std::lock_guard lock(mutex_);
    expires_ = Clock::now() + host_.options.session_ttl;
    used_ = true;
}

bool Session::expired() const {
    const std::lock_guard lock(mutex_);
    return Clock::now() >= expires_ && held_ == 0 && !changing_ && queue_->idle();
}

std::shared_ptr<void> Session::hold(const std::shared_ptr<Session>& session) {
    {
        const std::lock_guard lock(session->mutex_);
        ++session->held_;
    }
    return {session.get(), [session](void*) {
                session->touch();
                const std::lock_guard lock(session->mutex_);
                --session->held_;
            }};
}

std::optional<Session::Clock::time_point> Session::take_expiry() {
    const std::lock_guard lock(mutex_);
    if (!std::exchange(used_, false)) return std::nullopt;
    return expires_;
}

void Session::put_expiry_back() {
    const std::lock_guard lock(mutex_);
    used_ = true;
}

Status Session::require_idle() const {
    const std::lock_guard lock(mutex_);
    return require_idle_locked();
}

Status Session::require_open_locked() const {
    if (!closed_) return Done{};
    if (closed_->cause == Cause::kUnavailable) return *closed_;  // the server ends, and the session is there afterwards
    return Error{Cause::kNotFound, "the session was deleted in the meantime", "session"};
}

Status Session::require_idle_locked() const {
    if (Status open = require_open_locked(); !open) return open;
    if (changing_) return busy_uploading();
    if (queue_->idle()) return Done{};
    return Error{Cause::kBusy,
                 "a method runs or waits in this session; upload when it is done or cancelled, or into another session",
                 "session"};
}

Status Session::require_room() const {
    const std::lock_guard lock(mutex_);
    return require_room_locked();
}

Status Session::require_room_locked() const {
    const std::uint32_t limit = host_.options.limits.representations;
    if (representations_.size() < limit) return Done{};
    return Error{Cause::kLimitExceeded,
                 "the session has " + std::to_string(limit) + " representations, the server's limit max_representations; " +
                     "upload the mesh again to drop them, or use another session",
                 "session"};
}

Status Session::set_source(std::shared_ptr<const SourceMesh> source) { return change_source(nullptr, source); }

Status Session::replace_source(const std::shared_ptr<const SourceMesh>& before, std::shared_ptr<const SourceMesh> source) {
    return change_source(before.get(), source);
}

Status Session::begin_change(const SourceMesh* before) {
    const std::lock_guard lock(mutex_);
    if (before != nullptr && source_.get() != before) {
        return Error{Cause::kBusy, "the session got another mesh in the meantime; nothing was changed", "session", kRetryAfter};
    }
    if (Status idle = require_idle_locked(); !idle) return idle;
    changing_ = true;
    return Done{};
}

Status Session::change_source(const SourceMesh* before, std::shared_ptr<const SourceMesh>& source) {
    if (Status begun = begin_change(before); !begun) return begun;
    Status kept = host_.archive.set_source(number_, *source);
    Pointers dropped;  // freed after the lock is released
    const std::lock_guard lock(mutex_);
    changing_ = false;
    if (!kept) return kept;
    if (Status open = require_open_locked(); !open) return open;
    source_.swap(source);
    representations_.swap(dropped);
    unfinished_.clear();
    return Done{};
}

SessionSnapshot::RepresentationPointer Session::find_made(const MethodRequest& request) const {
    const std::lock_guard lock(mutex_);
    const auto made = std::find_if(representations_.begin(), representations_.end(),
                                   [&](const auto& representation) { return representation->asked() == request; });
    return made == representations_.end() ? nullptr : *made;
}

Expected<SessionSnapshot::RepresentationPointer> Session::add_representation(const MethodRequest& request, MethodResult result) {
    std::uint64_t made = 0;
    {
        const std::lock_guard lock(mutex_);
        if (Status open = require_open_locked(); !open) return open.error();
        if (Status room = require_room_locked(); !room) return room.error();
        made = ++made_;
    }
    const MrrExtent extent = extent_of(result.mrr);
    const std::uint64_t bytes = memory_of(result.mrr);
    auto levels = Kept<Levels>::hold(std::make_shared<const Levels>(std::move(result.mrr), host_.memory), bytes, host_.memory);
    auto added =
        std::make_shared<const Representation>('r' + std::to_string(made), request, std::move(result), extent, std::move(levels));
    if (Status kept = host_.archive.add_representation(number_, *added, made); !kept) return kept.error();
    const std::lock_guard lock(mutex_);
    if (Status open = require_open_locked(); !open) return open.error();
    representations_.push_back(added);
    expires_ = Clock::now() + host_.options.session_ttl;
    used_ = true;
    return SessionSnapshot::RepresentationPointer(std::move(added));
}

void Session::answered(const MethodRequest& request) {
    std::vector<std::uint64_t> jobs;
    {
        const std::lock_guard lock(mutex_);
        const auto kept = std::stable_partition(unfinished_.begin(), unfinished_.end(),
                                                [&](const UnfinishedMethod& method) { return method.request != request; });
        for (auto method = kept; method != unfinished_.end(); ++method) jobs.push_back(method->job);
        unfinished_.erase(kept, unfinished_.end());
    }
    // Where this fails the method is told again after the next start, with its result beside it.
    if (!jobs.empty()) static_cast<void>(host_.archive.remove_jobs(jobs));
}

Expected<std::shared_ptr<Job>> Session::enqueue(const MethodOptions& options, const MakeJob& make) {
    const std::lock_guard lock(mutex_);
    if (Status open = require_open_locked(); !open) return open.error();
    if (changing_) return busy_uploading();
    const bool may_be_made = std::any_of(representations_.begin(), representations_.end(),
                                         [&](const auto& made) { return made->asked().options == options; });
    if (Status room = require_room_locked(); !room && !may_be_made) return room.error();
    Expected<std::shared_ptr<Job>> job = make(snapshot_locked());
    if (!job) return job;
    if (Status pushed = queue_->push(*job); !pushed) return pushed.error();
    return job;
}

void Session::close(const Error& why) {
    {
        const std::lock_guard lock(mutex_);
        closed_ = why;
    }
    queue_->close(why);
}

}  // namespace vsplit::service

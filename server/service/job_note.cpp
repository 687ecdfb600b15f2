#include "service/job_note.h"

#include <utility>

namespace vsplit::service {

JobNote::JobNote(SessionArchive& archive, std::uint64_t session, MethodRequest request)
    : archive_(archive), session_(session), request_(std::move(request)) {}

// A note that cannot be written, or not be erased, must not keep the method from what it does.
void JobNote::write() {
    const std::lock_guard lock(mutex_);
    if (ended_) return;
    const Expected<std::uint64_t> job = archive_.add_job(session_, request_);
    if (job) job_ = *job;
}

void JobNote::erase() {
    const std::lock_guard lock(mutex_);
    ended_ = true;
    if (job_) static_cast<void>(archive_.remove_jobs({*job_}));
    job_.reset();
}

}  // namespace vsplit::service

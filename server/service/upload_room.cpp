#include "service/upload_room.h"

#include <string>

#include "service/limits.h"

namespace vsplit::service {

Status UploadRoom::Share::grow(std::uint64_t bytes) {
    if (Status taken = room_->take(bytes); !taken) return taken;
    bytes_ += bytes;
    return Done{};
}

Status UploadRoom::take(std::uint64_t bytes) {
    const std::lock_guard lock(mutex_);
    if (Status room = require_locked(bytes); !room) return room;
    taken_ += bytes;
    return Done{};
}

Status UploadRoom::require(std::uint64_t bytes) {
    const std::lock_guard lock(mutex_);
    return require_locked(bytes);
}

Status UploadRoom::require_locked(std::uint64_t bytes) const {
    const std::uint64_t kept = archive_.use().bytes;
    if (limit_ != 0 && (bytes > limit_ || kept + taken_ > limit_ - bytes)) {
        return Error{Cause::kLimitExceeded,
                     "sessions take " + std::to_string(kept) + " bytes of disk and uploads on their way " +
                         std::to_string(taken_) + "; the server's limit max_disk_bytes, " + std::to_string(limit_) +
                         ", leaves no room for " + std::to_string(bytes) + " more",
                     "data", bytes <= limit_ ? kRetryAfter : 0};
    }
    return Done{};
}

void UploadRoom::give_back(std::uint64_t bytes) {
    const std::lock_guard lock(mutex_);
    taken_ -= bytes;
}

}  // namespace vsplit::service

#pragma once

#include <cstdint>
#include <memory>
#include <mutex>

#include "service/session_archive.h"
#include "vsplit/base/expected.h"

namespace vsplit::service {

/// The disk that uploads on their way take, beside what the archive has. Thread-safe.
class UploadRoom {
public:
    /// \param limit bytes of both together; 0: none. \param archive outlives it
    UploadRoom(const SessionArchive& archive, std::uint64_t limit) : archive_(archive), limit_(limit) {}

    /// What one upload has; given back at its end.
    class Share {
    public:
        explicit Share(UploadRoom& room) : room_(&room) {}
        ~Share() { room_->give_back(bytes_); }
        Share(const Share&) = delete;
        Share& operator=(const Share&) = delete;

        /// \return LIMIT_EXCEEDED.
        [[nodiscard]] Status grow(std::uint64_t bytes);

    private:
        UploadRoom* room_;
        std::uint64_t bytes_ = 0;
    };

    /// Whether so many bytes would find room now. \return LIMIT_EXCEEDED.
    [[nodiscard]] Status require(std::uint64_t bytes);

    [[nodiscard]] std::unique_ptr<Share> share() { return std::make_unique<Share>(*this); }

private:
    [[nodiscard]] Status take(std::uint64_t bytes);
    [[nodiscard]] Status require_locked(std::uint64_t bytes) const;
    void give_back(std::uint64_t bytes);

    const SessionArchive& archive_;
    const std::uint64_t limit_;
    std::mutex mutex_;
    std::uint64_t taken_ = 0;
};

}  // namespace vsplit::service

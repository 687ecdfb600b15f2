#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "service/session.h"

namespace vsplit::service {

/// Some sessions in order of creation, and where the rest begins.
struct SessionPage {
    std::vector<SessionSnapshot> sessions;
    std::string next_page_token;  ///< empty on the last page
};

/// The sessions of a server, in memory. Thread-safe.
class SessionStore {
public:
    static constexpr std::uint32_t kDefaultPage = 100;
    static constexpr std::uint32_t kLargestPage = 1000;

    SessionStore(const ServiceOptions& options, WorkerPool& workers) : options_(options), workers_(workers) {}

    /// Whether `create` has room. \return LIMIT_EXCEEDED.
    [[nodiscard]] Status require_room(std::string_view owner = {});

    /// \return LIMIT_EXCEEDED. `source` may be null.
    [[nodiscard]] Expected<std::shared_ptr<Session>> create(std::shared_ptr<const SourceMesh> source,
                                                            const std::string& owner = {});

    /// A use of the session: it lives its full time again. \return NOT_FOUND, also for a session of another owner.
    [[nodiscard]] Expected<std::shared_ptr<Session>> find(std::string_view id, std::string_view owner = {});

    /// Closes and forgets the session. \return as `find`.
    [[nodiscard]] Status remove(std::string_view id, std::string_view owner = {});

    /// `page_size` 0 means kDefaultPage. Looking at the list is no use of the sessions in it.
    /// \return INVALID_OPTION for a token that is none of ours. O(sessions).
    [[nodiscard]] Expected<SessionPage> list(std::uint32_t page_size, std::string_view page_token,
                                             std::string_view owner = {}) const;

    [[nodiscard]] std::size_t count() const;

    /// Jobs that wait for another one of their session. O(sessions).
    [[nodiscard]] std::size_t waiting_jobs() const;

    /// Closes and forgets those nobody has used for their time. Returns how many. O(sessions).
    std::size_t remove_expired();

    /// Closes and forgets all.
    void clear(const Error& why);

private:
    using Sessions = std::map<std::uint64_t, std::shared_ptr<Session>>;

    [[nodiscard]] Status require_room_locked(std::string_view owner) const;
    [[nodiscard]] std::vector<std::shared_ptr<Session>> take_expired();
    void forget_owner_of(const Session& session);

    const ServiceOptions options_;
    WorkerPool& workers_;
    mutable std::mutex mutex_;
    Sessions sessions_;  // by number
    std::unordered_map<std::string, std::uint64_t> numbers_;
    std::map<std::string, std::uint32_t, std::less<>> by_owner_;  // how many sessions; none is no entry
    std::uint64_t last_number_ = 0;
};

}  // namespace vsplit::service

#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
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

/// The sessions of a server, as its archive has them. Thread-safe. Whatever changes which there are may wait for the archive.
class SessionStore {
public:
    static constexpr std::uint32_t kDefaultPage = 100;
    static constexpr std::uint32_t kLargestPage = 1000;

    /// Starts empty. `host` outlives this.
    explicit SessionStore(const SessionHost& host);

    /// Takes over what the archive holds. To be called once, before anything else. \return what SessionArchive::restore returns.
    [[nodiscard]] Status restore();

    /// Whether `create` has room. \return LIMIT_EXCEEDED.
    [[nodiscard]] Status require_room(std::string_view owner = {});

    /// `source` may be null. \return LIMIT_EXCEEDED; what SessionArchive::add returns.
    [[nodiscard]] Expected<std::shared_ptr<Session>> create(std::shared_ptr<const SourceMesh> source,
                                                            const std::string& owner = {});

    /// A use of the session: it lives its full time again. \return NOT_FOUND, also for a session of another owner; CORRUPT for
    /// one that the archive found damaged.
    [[nodiscard]] Expected<std::shared_ptr<Session>> find(std::string_view id, std::string_view owner = {});

    /// Closes and forgets the session, also one that is damaged. \return NOT_FOUND as `find`; what SessionArchive::remove
    /// returns, and it is there still.
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

    /// Tells the archive what time it is and which sessions were used. \return what it returns. O(sessions).
    [[nodiscard]] Status note_time();

    /// Tells the archive that this session was used. May wait for it. \return what SessionArchive::note_time returns.
    [[nodiscard]] Status note_use(const std::shared_ptr<Session>& session);

    /// Closes all; the archive keeps them. From now on `find` and `create` return `why`.
    void clear(const Error& why);

private:
    using Sessions = std::map<std::uint64_t, std::shared_ptr<Session>>;

    [[nodiscard]] const DamagedSession* find_damaged(std::string_view id, std::string_view owner) const;
    [[nodiscard]] Status remove_damaged(std::string_view id, std::string_view owner);
    [[nodiscard]] Error not_served(std::string_view id, std::string_view owner) const;
    [[nodiscard]] Status require_room_locked(std::string_view owner) const;
    [[nodiscard]] Expected<std::uint64_t> begin_session(const std::string& owner);
    void publish(const std::shared_ptr<Session>& session);
    void forget_owner(const std::string& owner);
    [[nodiscard]] Status note_time(const std::vector<std::shared_ptr<Session>>& sessions);
    [[nodiscard]] std::chrono::milliseconds service_time(Session::Clock::time_point time) const;
    [[nodiscard]] std::vector<std::shared_ptr<Session>> take_expired();

    const SessionHost host_;
    Session::Clock::time_point began_ = Session::Clock::now();  // when service time was 0
    std::mutex noting_;         // held while the archive is told the time, which must not run backwards
    mutable std::mutex mutex_;  // not held while the archive is called
    Sessions sessions_;         // by number
    std::unordered_map<std::string, std::uint64_t> numbers_;
    std::unordered_map<std::string, DamagedSession> damaged_;     // by id; of when the server began
    std::map<std::string, std::uint32_t, std::less<>> by_owner_;  // sessions, with those on their way; none is no entry
    std::size_t count_ = 0;                                       // sessions, with those on their way
    std::uint64_t last_number_ = 0;
    std::optional<Error> ended_;          // why all sessions were closed
    std::vector<std::uint64_t> expired_;  // sessions that the archive has still to forget
};

}  // namespace vsplit::service

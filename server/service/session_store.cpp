#include "service/session_store.h"

#include <algorithm>
#include <charconv>
#include <iterator>
#include <utility>

#include "service/quoted.h"
#include "service/random_id.h"

namespace vsplit::service {
namespace {

Error unknown_session(std::string_view id) {
    return {Cause::kNotFound,
            "no session " + quoted(id) + "; it may have been deleted or have expired, and CreateSession makes a new one",
            "session"};
}

// A token is the number of the last session on the page before; 0 stands for none.
Expected<std::uint64_t> parse_token(std::string_view token) {
    std::uint64_t number = 0;
    if (token.empty()) return number;
    const auto [end, failed] = std::from_chars(token.data(), token.data() + token.size(), number);
    if (failed == std::errc() && end == token.data() + token.size()) return number;
    return Error{Cause::kInvalidOption,
                 "page_token is " + quoted(token) + "; it must be a next_page_token of ListSessions, or empty for the first page",
                 "page_token"};
}

}  // namespace

Status SessionStore::require_room() {
    remove_expired();
    const std::lock_guard lock(mutex_);
    return require_room_locked();
}

std::size_t SessionStore::count() const {
    const std::lock_guard lock(mutex_);
    return sessions_.size();
}

std::size_t SessionStore::waiting_jobs() const {
    const std::lock_guard lock(mutex_);
    std::size_t waiting = 0;
    for (const auto& [number, session] : sessions_) waiting += session->waiting_jobs();
    return waiting;
}

Status SessionStore::require_room_locked() const {
    if (sessions_.size() < options_.limits.sessions) return Done{};
    return Error{Cause::kLimitExceeded,
                 "the server holds " + std::to_string(sessions_.size()) +
                     " sessions, its limit max_sessions; delete one, or wait until one expires",
                 "", kRetryAfter};
}

Expected<std::shared_ptr<Session>> SessionStore::create(std::shared_ptr<const SourceMesh> source) {
    remove_expired();
    Expected<std::string> id = random_id();
    if (!id) return id.error();
    const std::lock_guard lock(mutex_);
    if (Status room = require_room_locked(); !room) return room.error();
    auto session = std::make_shared<Session>(*id, ++last_number_, std::move(source), options_, workers_);
    numbers_.emplace(*id, last_number_);
    sessions_.emplace(last_number_, session);
    return session;
}

Expected<std::shared_ptr<Session>> SessionStore::find(std::string_view id) {
    const std::lock_guard lock(mutex_);
    const auto number = numbers_.find(std::string(id));
    if (number == numbers_.end()) return unknown_session(id);
    const std::shared_ptr<Session>& session = sessions_.at(number->second);
    if (session->expired()) return unknown_session(id);
    session->touch();
    return session;
}

Status SessionStore::remove(std::string_view id) {
    std::shared_ptr<Session> removed;
    {
        const std::lock_guard lock(mutex_);
        const auto number = numbers_.find(std::string(id));
        if (number == numbers_.end()) return unknown_session(id);
        const auto entry = sessions_.find(number->second);
        removed = std::move(entry->second);
        sessions_.erase(entry);
        numbers_.erase(number);
    }
    removed->close({Cause::kCancelled, "the session was deleted", "session"});
    return Done{};
}

Expected<SessionPage> SessionStore::list(std::uint32_t page_size, std::string_view page_token) const {
    Expected<std::uint64_t> after = parse_token(page_token);
    if (!after) return after.error();
    const std::uint32_t most = page_size == 0 ? kDefaultPage : std::min(page_size, kLargestPage);
    SessionPage page;
    const std::lock_guard lock(mutex_);
    auto at = sessions_.upper_bound(*after);
    for (; at != sessions_.end() && page.sessions.size() < most; ++at) {
        if (!at->second->expired()) page.sessions.push_back(at->second->snapshot());
    }
    if (at != sessions_.end()) page.next_page_token = std::to_string(std::prev(at)->first);
    return page;
}

std::size_t SessionStore::remove_expired() {
    const std::vector<std::shared_ptr<Session>> taken = take_expired();
    for (const std::shared_ptr<Session>& session : taken) session->close({Cause::kCancelled, "the session expired", "session"});
    return taken.size();
}

std::vector<std::shared_ptr<Session>> SessionStore::take_expired() {
    std::vector<std::shared_ptr<Session>> taken;
    const std::lock_guard lock(mutex_);
    for (auto at = sessions_.begin(); at != sessions_.end();) {
        if (!at->second->expired()) {
            ++at;
            continue;
        }
        numbers_.erase(at->second->id());
        taken.push_back(std::move(at->second));
        at = sessions_.erase(at);
    }
    return taken;
}

void SessionStore::clear(const Error& why) {
    Sessions removed;
    {
        const std::lock_guard lock(mutex_);
        removed.swap(sessions_);
        numbers_.clear();
    }
    for (const auto& [number, session] : removed) session->close(why);
}

}  // namespace vsplit::service

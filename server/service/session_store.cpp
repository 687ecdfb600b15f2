#include "service/session_store.h"

#include <algorithm>
#include <charconv>
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

Status SessionStore::require_room(std::string_view owner) {
    remove_expired();
    const std::lock_guard lock(mutex_);
    return require_room_locked(owner);
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

Status SessionStore::require_room_locked(std::string_view owner) const {
    const auto held = by_owner_.find(owner);
    if (!owner.empty() && held != by_owner_.end() && held->second >= options_.limits.sessions_by_client) {
        return Error{
            Cause::kLimitExceeded,
            "there are " + std::to_string(held->second) +
                " sessions of this token, the server's limit max_sessions_by_client; delete one, or wait until one expires",
            "", kRetryAfter};
    }
    if (sessions_.size() < options_.limits.sessions) return Done{};
    return Error{Cause::kLimitExceeded,
                 "the server holds " + std::to_string(sessions_.size()) +
                     " sessions, its limit max_sessions; delete one, or wait until one expires",
                 "", kRetryAfter};
}

Expected<std::shared_ptr<Session>> SessionStore::create(std::shared_ptr<const SourceMesh> source, const std::string& owner) {
    remove_expired();
    Expected<std::string> id = random_id();
    if (!id) return id.error();
    const std::lock_guard lock(mutex_);
    if (Status room = require_room_locked(owner); !room) return room.error();
    auto session = std::make_shared<Session>(*id, ++last_number_, std::move(source), options_, workers_, owner);
    ++by_owner_[owner];
    numbers_.emplace(*id, last_number_);
    sessions_.emplace(last_number_, session);
    return session;
}

Expected<std::shared_ptr<Session>> SessionStore::find(std::string_view id, std::string_view owner) {
    const std::lock_guard lock(mutex_);
    const auto number = numbers_.find(std::string(id));
    if (number == numbers_.end()) return unknown_session(id);
    const std::shared_ptr<Session>& session = sessions_.at(number->second);
    if (session->owner() != owner || session->expired()) return unknown_session(id);
    session->touch();
    return session;
}

Status SessionStore::remove(std::string_view id, std::string_view owner) {
    std::shared_ptr<Session> removed;
    {
        const std::lock_guard lock(mutex_);
        const auto number = numbers_.find(std::string(id));
        if (number == numbers_.end()) return unknown_session(id);
        const auto entry = sessions_.find(number->second);
        if (entry->second->owner() != owner) return unknown_session(id);
        forget_owner_of(*entry->second);
        removed = std::move(entry->second);
        sessions_.erase(entry);
        numbers_.erase(number);
    }
    removed->close({Cause::kCancelled, "the session was deleted", "session"});
    return Done{};
}

Expected<SessionPage> SessionStore::list(std::uint32_t page_size, std::string_view page_token, std::string_view owner) const {
    Expected<std::uint64_t> after = parse_token(page_token);
    if (!after) return after.error();
    const std::uint32_t most = page_size == 0 ? kDefaultPage : std::min(page_size, kLargestPage);
    SessionPage page;
    const std::lock_guard lock(mutex_);
    std::uint64_t last = 0;
    for (auto at = sessions_.upper_bound(*after); at != sessions_.end(); ++at) {
        if (at->second->owner() != owner || at->second->expired()) continue;
        if (page.sessions.size() == most) {
            page.next_page_token = std::to_string(last);
            break;
        }
        page.sessions.push_back(at->second->snapshot());
        last = at->first;
    }
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
        forget_owner_of(*at->second);
        taken.push_back(std::move(at->second));
        at = sessions_.erase(at);
    }
    return taken;
}

// Lock held.
void SessionStore::forget_owner_of(const Session& session) {
    const auto held = by_owner_.find(session.owner());
    if (--held->second == 0) by_owner_.erase(held);
}

void SessionStore::clear(const Error& why) {
    Sessions removed;
    {
        const std::lock_guard lock(mutex_);
        removed.swap(sessions_);
        numbers_.clear();
        by_owner_.clear();
    }
    for (const auto& [number, session] : removed) session->close(why);
}

}  // namespace vsplit::service

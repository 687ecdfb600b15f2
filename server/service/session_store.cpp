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
            "no session " + quoted(id) + "; it may have been deleted or have expired, and a new one can be created", "session"};
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

SessionStore::SessionStore(const SessionHost& host) : host_(host) {}

Status SessionStore::restore() {
    Expected<Restored> restored = host_.archive.restore(host_.memory);
    if (!restored) return restored.error();
    began_ = Session::Clock::now() - restored->now;
    last_number_ = restored->last_number;
    for (DamagedSession& session : restored->damaged) damaged_.emplace(session.id, std::move(session));
    for (SessionRecord& record : restored->sessions) {
        ++by_owner_[record.owner];
        ++count_;
        publish(std::make_shared<Session>(std::move(record), began_, host_));
    }
    return Done{};
}

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
    if (ended_) return *ended_;
    const Limits& limits = host_.options.limits;
    const auto held = by_owner_.find(owner);
    if (!owner.empty() && held != by_owner_.end() && held->second >= limits.sessions_by_client) {
        return Error{
            Cause::kLimitExceeded,
            "there are " + std::to_string(held->second) +
                " sessions of this token, the server's limit max_sessions_by_client; delete one, or wait until one expires",
            "", kRetryAfter};
    }
    if (count_ < limits.sessions) return Done{};
    return Error{
        Cause::kLimitExceeded,
        "the server holds " + std::to_string(count_) + " sessions, its limit max_sessions; delete one, or wait until one expires",
        "", kRetryAfter};
}

/// Why nothing is served under that id. Lock held.
Error SessionStore::not_served(std::string_view id, std::string_view owner) const {
    const DamagedSession* const damaged = find_damaged(id, owner);
    if (damaged == nullptr) return unknown_session(id);
    return {Cause::kCorrupt,
            "session " + quoted(id) + " is damaged and was set aside: " + damaged->why +
                "; ask who runs the server for a backup, or delete it and upload the mesh to a new session",
            "session"};
}

/// Null where there is none. Lock held.
const DamagedSession* SessionStore::find_damaged(std::string_view id, std::string_view owner) const {
    const auto damaged = damaged_.find(std::string(id));
    return damaged == damaged_.end() || damaged->second.owner != owner ? nullptr : &damaged->second;
}

Status SessionStore::remove_damaged(std::string_view id, std::string_view owner) {
    std::uint64_t number = 0;
    {
        const std::lock_guard lock(mutex_);
        const DamagedSession* const damaged = find_damaged(id, owner);
        if (damaged == nullptr) return unknown_session(id);
        number = damaged->number;
    }
    if (Status removed = host_.archive.remove({number}); !removed) return removed;
    const std::lock_guard lock(mutex_);
    damaged_.erase(std::string(id));
    return Done{};
}

std::chrono::milliseconds SessionStore::service_time(Session::Clock::time_point time) const {
    return std::chrono::duration_cast<std::chrono::milliseconds>(time - began_);
}

/// Counts a session that is on its way into the archive. Returns its number.
Expected<std::uint64_t> SessionStore::begin_session(const std::string& owner) {
    const std::lock_guard lock(mutex_);
    if (Status room = require_room_locked(owner); !room) return room.error();
    ++by_owner_[owner];
    ++count_;
    return ++last_number_;
}

void SessionStore::publish(const std::shared_ptr<Session>& session) {
    const std::lock_guard lock(mutex_);
    numbers_.emplace(session->id(), session->number());
    sessions_.emplace(session->number(), session);
}

Expected<std::shared_ptr<Session>> SessionStore::create(std::shared_ptr<const SourceMesh> source, const std::string& owner) {
    remove_expired();
    Expected<std::string> id = random_id();
    if (!id) return id.error();
    const Expected<std::uint64_t> number = begin_session(owner);
    if (!number) return number.error();
    SessionRecord record;
    record.number = *number;
    record.id = *std::move(id);
    record.owner = owner;
    record.create_time = std::chrono::floor<std::chrono::milliseconds>(std::chrono::system_clock::now());
    record.expires = service_time(Session::Clock::now() + host_.options.session_ttl);
    record.source = std::move(source);
    if (Status kept = host_.archive.add(record); !kept) {
        const std::lock_guard lock(mutex_);
        forget_owner(owner);
        return kept.error();
    }
    auto session = std::make_shared<Session>(std::move(record), began_, host_);
    publish(session);
    return session;
}

Expected<std::shared_ptr<Session>> SessionStore::find(std::string_view id, std::string_view owner) {
    const std::lock_guard lock(mutex_);
    if (ended_) return *ended_;
    const auto number = numbers_.find(std::string(id));
    if (number == numbers_.end()) return not_served(id, owner);
    const std::shared_ptr<Session>& session = sessions_.at(number->second);
    if (session->owner() != owner || session->expired()) return unknown_session(id);
    session->touch();
    return session;
}

Status SessionStore::remove(std::string_view id, std::string_view owner) {
    const Expected<std::shared_ptr<Session>> found = find(id, owner);
    if (!found && found.error().cause == Cause::kCorrupt) return remove_damaged(id, owner);
    if (!found) return found.error();
    const std::shared_ptr<Session>& session = *found;
    if (Status removed = host_.archive.remove({session->number()}); !removed) return removed;
    {
        const std::lock_guard lock(mutex_);
        if (sessions_.erase(session->number()) == 0) return unknown_session(id);  // another caller was quicker
        numbers_.erase(session->id());
        forget_owner(session->owner());
    }
    session->close({Cause::kCancelled, "the session was deleted", "session"});
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
    for (const std::shared_ptr<Session>& session : taken) {
        session->close({Cause::kCancelled, "the session expired", "session"});
        if (host_.options.on_expired) host_.options.on_expired(session->id());
    }
    std::vector<std::uint64_t> numbers;
    {
        const std::lock_guard lock(mutex_);
        for (const std::shared_ptr<Session>& session : taken) expired_.push_back(session->number());
        numbers.swap(expired_);
    }
    if (!numbers.empty() && !host_.archive.remove(numbers)) {  // a full disk, say: the next sweep tries again
        const std::lock_guard lock(mutex_);
        expired_.insert(expired_.end(), numbers.begin(), numbers.end());
    }
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
        forget_owner(at->second->owner());
        taken.push_back(std::move(at->second));
        at = sessions_.erase(at);
    }
    return taken;
}

Status SessionStore::note_time() {
    std::vector<std::shared_ptr<Session>> all;
    {
        const std::lock_guard lock(mutex_);
        all.reserve(sessions_.size());
        for (const auto& [number, session] : sessions_) all.push_back(session);
    }
    return note_time(all);
}

Status SessionStore::note_use(const std::shared_ptr<Session>& session) { return note_time({session}); }

Status SessionStore::note_time(const std::vector<std::shared_ptr<Session>>& sessions) {
    std::vector<std::pair<std::uint64_t, std::chrono::milliseconds>> expire;
    std::vector<std::shared_ptr<Session>> told;
    const std::lock_guard lock(noting_);
    for (const std::shared_ptr<Session>& session : sessions) {
        const auto time = session->take_expiry();
        if (!time) continue;
        expire.emplace_back(session->number(), service_time(*time));
        told.push_back(session);
    }
    Status noted = host_.archive.note_time(service_time(Session::Clock::now()), expire);
    for (const std::shared_ptr<Session>& session : told) {
        if (!noted) session->put_expiry_back();
    }
    return noted;
}

// Lock held.
void SessionStore::forget_owner(const std::string& owner) {
    const auto held = by_owner_.find(owner);
    if (held == by_owner_.end()) return;  // all were forgotten meanwhile
    if (--held->second == 0) by_owner_.erase(held);
    --count_;
}

void SessionStore::clear(const Error& why) {
    Sessions removed;
    {
        const std::lock_guard lock(mutex_);
        ended_ = why;
        removed.swap(sessions_);
        numbers_.clear();
        by_owner_.clear();
        count_ = 0;
    }
    for (const auto& [number, session] : removed) session->close(why);
}

}  // namespace vsplit::service

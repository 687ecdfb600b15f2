#include "store/sqlite_session_index.h"

#include <set>
#include <string>
#include <utility>

namespace vsplit::store {
namespace {

// Of the schema, in the database's user_version. 0 is a new database.
constexpr std::int64_t kVersion = 1;

constexpr const char* kSchema = R"(
CREATE TABLE clock (now INTEGER NOT NULL) STRICT;
INSERT INTO clock VALUES (0);
CREATE TABLE sessions (
    number INTEGER PRIMARY KEY, id TEXT NOT NULL UNIQUE, owner TEXT NOT NULL, created INTEGER NOT NULL,
    expires INTEGER NOT NULL, made INTEGER NOT NULL, blob TEXT NOT NULL, info BLOB NOT NULL,
    damage TEXT  -- why it is set aside
) STRICT;
CREATE INDEX sessions_by_blob ON sessions (blob);
CREATE TABLE representations (
    session INTEGER NOT NULL REFERENCES sessions ON DELETE CASCADE, number INTEGER NOT NULL, blob TEXT NOT NULL,
    info BLOB NOT NULL, UNIQUE (session, number)
) STRICT;
CREATE INDEX representations_by_blob ON representations (blob);
CREATE TABLE jobs (
    number INTEGER PRIMARY KEY AUTOINCREMENT, session INTEGER NOT NULL REFERENCES sessions ON DELETE CASCADE, info BLOB NOT NULL
) STRICT;
CREATE INDEX jobs_by_session ON jobs (session);
PRAGMA user_version = 1;
)";

Error no_session() { return {Cause::kNotFound, "the session was deleted in the meantime", "session"}; }

Expected<std::int64_t> one_number(Database& database, const char* sql) {
    Statement statement = database.prepare(sql);
    const Expected<bool> row = statement.step();
    if (!row) return row.error();
    return *row ? statement.number(0) : 0;
}

// "ok" where the database is sound.
Status check(Database& database) {
    Statement statement = database.prepare("PRAGMA quick_check(1)");
    const Expected<bool> row = statement.step();
    if (!row) return row.error();
    const std::string told = *row ? statement.bytes(0) : "nothing";
    if (told == "ok") return Done{};
    return Error{Cause::kCorrupt, "the data directory's index: " + told, ""};
}

}  // namespace

Expected<std::unique_ptr<SqliteSessionIndex>> SqliteSessionIndex::open(const std::filesystem::path& file, bool writable) {
    Expected<Database> database = Database::open(file, writable);
    if (!database) return database.error();
    std::unique_ptr<SqliteSessionIndex> index(new SqliteSessionIndex(*std::move(database)));
    if (Status ready = index->prepare_schema(writable); !ready) return ready.error();
    return index;
}

Status SqliteSessionIndex::prepare_schema(bool writable) {
    for (const char* setting : {"PRAGMA synchronous = FULL", "PRAGMA foreign_keys = ON", "PRAGMA journal_mode = WAL"}) {
        if (!writable) break;
        if (Status set = database_.run(setting); !set) return set;
    }
    if (Status sound = check(database_); !sound) return sound;
    const Expected<std::int64_t> version = one_number(database_, "PRAGMA user_version");
    if (!version) return version.error();
    if (*version == kVersion) return Done{};
    if (*version > kVersion) {
        return Error{Cause::kUnsupported,
                     "the data directory's index has version " + std::to_string(*version) +
                         "; this vsplitd knows versions up to " + std::to_string(kVersion) + ", and a later one is needed",
                     "data_dir"};
    }
    Transaction transaction(database_);
    if (Status begun = transaction.begin(); !begun) return begun;
    if (Status made = database_.run(kSchema); !made) return made;
    return transaction.commit();
}

Expected<IndexContents> SqliteSessionIndex::load() {
    const std::lock_guard lock(mutex_);
    IndexContents contents;
    const Expected<std::int64_t> now = one_number(database_, "SELECT now FROM clock");
    if (!now) return now.error();
    contents.now = *now;
    const Expected<std::int64_t> last = one_number(database_, "SELECT max(number) FROM sessions");
    if (!last) return last.error();
    contents.last_session = static_cast<std::uint64_t>(*last);
    if (Status loaded = load_sessions(contents); !loaded) return loaded.error();
    if (Status loaded = load_representations(contents); !loaded) return loaded.error();
    if (Status loaded = load_jobs(contents); !loaded) return loaded.error();
    return contents;
}

Status SqliteSessionIndex::load_sessions(IndexContents& contents) {
    Statement rows = database_.prepare(
        "SELECT number, id, owner, created, expires, made, blob, info FROM sessions WHERE damage IS NULL ORDER BY number");
    for (;;) {
        const Expected<bool> row = rows.step();
        if (!row) return row.error();
        if (!*row) return Done{};
        contents.sessions.push_back({static_cast<std::uint64_t>(rows.number(0)),
                                     rows.bytes(1),
                                     rows.bytes(2),
                                     rows.number(3),
                                     rows.number(4),
                                     static_cast<std::uint64_t>(rows.number(5)),
                                     {rows.bytes(6), rows.bytes(7)}});
    }
}

Status SqliteSessionIndex::load_representations(IndexContents& contents) {
    Statement rows = database_.prepare(
        "SELECT r.session, r.number, r.blob, r.info FROM representations r JOIN sessions s ON s.number = r.session "
        "WHERE s.damage IS NULL ORDER BY r.session, r.number");
    for (;;) {
        const Expected<bool> row = rows.step();
        if (!row) return row.error();
        if (!*row) return Done{};
        contents.representations.push_back({static_cast<std::uint64_t>(rows.number(0)),
                                            static_cast<std::uint64_t>(rows.number(1)),
                                            {rows.bytes(2), rows.bytes(3)}});
    }
}

Status SqliteSessionIndex::load_jobs(IndexContents& contents) {
    Statement rows = database_.prepare("SELECT number, session, info FROM jobs ORDER BY number");
    for (;;) {
        const Expected<bool> row = rows.step();
        if (!row) return row.error();
        if (!*row) return Done{};
        contents.jobs.push_back(
            {static_cast<std::uint64_t>(rows.number(0)), static_cast<std::uint64_t>(rows.number(1)), rows.bytes(2)});
    }
}

Status SqliteSessionIndex::add_session(const SessionRow& session) {
    const std::lock_guard lock(mutex_);
    return database_.prepare("INSERT INTO sessions VALUES (?, ?, ?, ?, ?, ?, ?, ?, NULL)")
        .bind(session.number)
        .bind_text(session.id)
        .bind_text(session.owner)
        .bind(session.created)
        .bind(session.expires)
        .bind(session.made)
        .bind_text(session.source.blob)
        .bind_blob(session.source.info)
        .run();
}

Status SqliteSessionIndex::set_source(std::uint64_t session, const StoredItem& source) {
    const std::lock_guard lock(mutex_);
    Transaction transaction(database_);
    if (Status begun = transaction.begin(); !begun) return begun;
    Statement update = database_.prepare("UPDATE sessions SET blob = ?, info = ? WHERE number = ?");
    if (Status done = update.bind_text(source.blob).bind_blob(source.info).bind(session).run(); !done) return done;
    if (database_.changes() == 0) return no_session();
    if (Status done = database_.prepare("DELETE FROM representations WHERE session = ?").bind(session).run(); !done) return done;
    if (Status done = database_.prepare("DELETE FROM jobs WHERE session = ?").bind(session).run(); !done) return done;
    return transaction.commit();
}

Status SqliteSessionIndex::add_representation(const RepresentationRow& representation, std::uint64_t made) {
    const std::lock_guard lock(mutex_);
    Transaction transaction(database_);
    if (Status begun = transaction.begin(); !begun) return begun;
    Statement update = database_.prepare("UPDATE sessions SET made = ? WHERE number = ?");
    if (Status done = update.bind(made).bind(representation.session).run(); !done) return done;
    if (database_.changes() == 0) return no_session();
    Statement insert = database_.prepare("INSERT INTO representations VALUES (?, ?, ?, ?)");
    insert.bind(representation.session).bind(representation.number);
    insert.bind_text(representation.item.blob).bind_blob(representation.item.info);
    if (Status done = insert.run(); !done) return done;
    return transaction.commit();
}

// \pre lock held.
Status SqliteSessionIndex::for_each(const char* sql, const std::vector<std::uint64_t>& numbers) {
    Transaction transaction(database_);
    if (Status begun = transaction.begin(); !begun) return begun;
    Statement statement = database_.prepare(sql);
    for (const std::uint64_t number : numbers) {
        if (Status done = statement.bind(number).run(); !done) return done;
    }
    return transaction.commit();
}

Status SqliteSessionIndex::remove_sessions(const std::vector<std::uint64_t>& sessions) {
    const std::lock_guard lock(mutex_);
    return for_each("DELETE FROM sessions WHERE number = ?", sessions);
}

Status SqliteSessionIndex::note_time(std::int64_t now, const std::vector<std::pair<std::uint64_t, std::int64_t>>& expire) {
    const std::lock_guard lock(mutex_);
    Transaction transaction(database_);
    if (Status begun = transaction.begin(); !begun) return begun;
    if (Status done = database_.prepare("UPDATE clock SET now = ?").bind(now).run(); !done) return done;
    Statement update = database_.prepare("UPDATE sessions SET expires = ? WHERE number = ?");
    for (const auto& [session, time] : expire) {
        if (Status done = update.bind(time).bind(session).run(); !done) return done;
    }
    return transaction.commit();
}

Expected<std::uint64_t> SqliteSessionIndex::add_job(std::uint64_t session, const std::string& info) {
    const std::lock_guard lock(mutex_);
    Statement insert = database_.prepare("INSERT INTO jobs (session, info) SELECT number, ? FROM sessions WHERE number = ?");
    if (Status done = insert.bind_blob(info).bind(session).run(); !done) return done.error();
    if (database_.changes() == 0) return no_session();
    return database_.last_row();
}

Status SqliteSessionIndex::remove_jobs(const std::vector<std::uint64_t>& jobs) {
    const std::lock_guard lock(mutex_);
    return for_each("DELETE FROM jobs WHERE number = ?", jobs);
}

Status SqliteSessionIndex::set_aside(std::uint64_t session, const std::string& why) {
    const std::lock_guard lock(mutex_);
    return database_.prepare("UPDATE sessions SET damage = ? WHERE number = ?").bind_text(why).bind(session).run();
}

Expected<std::uint32_t> SqliteSessionIndex::count_aside() {
    const std::lock_guard lock(mutex_);
    const Expected<std::int64_t> count = one_number(database_, "SELECT count(*) FROM sessions WHERE damage IS NOT NULL");
    if (!count) return count.error();
    return static_cast<std::uint32_t>(*count);
}

Expected<std::vector<std::string>> SqliteSessionIndex::blobs_of(const std::vector<std::uint64_t>& sessions) {
    const std::lock_guard lock(mutex_);
    Statement statement = database_.prepare(
        "SELECT blob FROM sessions WHERE number = ?1 AND blob <> '' UNION SELECT blob FROM representations WHERE session = ?1");
    std::set<std::string> blobs;
    for (const std::uint64_t session : sessions) {
        statement.bind(session);
        for (Expected<bool> row = statement.step();; row = statement.step()) {
            if (!row) return row.error();
            if (!*row) break;
            blobs.insert(statement.bytes(0));
        }
        statement.reset();
    }
    return std::vector<std::string>(blobs.begin(), blobs.end());
}

Expected<std::vector<std::string>> SqliteSessionIndex::unused(const std::vector<std::string>& blobs) {
    const std::lock_guard lock(mutex_);
    Statement statement = database_.prepare(
        "SELECT EXISTS (SELECT 1 FROM sessions WHERE blob = ?1) OR EXISTS (SELECT 1 FROM representations WHERE blob = ?1)");
    std::vector<std::string> unused;
    for (const std::string& blob : blobs) {
        const Expected<bool> row = statement.bind_text(blob).step();
        if (!row) return row.error();
        if (statement.number(0) == 0) unused.push_back(blob);
        statement.reset();
    }
    return unused;
}

}  // namespace vsplit::store

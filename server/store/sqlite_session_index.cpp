#include "store/sqlite_session_index.h"

#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <utility>

#include "store/index_rows.h"

namespace vsplit::store {
namespace {

// The schema is what these steps make, one after the other; the database's user_version is how many were taken. Triggers, not
// foreign keys, take away what is a session's: they work for whoever deletes a row, by whatever program.
constexpr const char* kFirstStep = R"(
CREATE TABLE clock (now INTEGER NOT NULL) STRICT;
INSERT INTO clock VALUES (0);
CREATE TABLE sessions (
    number INTEGER PRIMARY KEY AUTOINCREMENT, id TEXT NOT NULL UNIQUE, owner TEXT NOT NULL, created INTEGER NOT NULL,
    expires INTEGER NOT NULL, made INTEGER NOT NULL, blob TEXT NOT NULL, info BLOB NOT NULL,
    digest TEXT NOT NULL,  -- of number, id, owner, created, blob and info
    damage TEXT            -- why it is set aside
) STRICT;
CREATE INDEX sessions_by_blob ON sessions (blob);
CREATE TABLE representations (
    session INTEGER NOT NULL, number INTEGER NOT NULL, blob TEXT NOT NULL, info BLOB NOT NULL, digest TEXT NOT NULL,
    UNIQUE (session, number)
) STRICT;
CREATE INDEX representations_by_blob ON representations (blob);
CREATE TABLE jobs (number INTEGER PRIMARY KEY AUTOINCREMENT, session INTEGER NOT NULL, info BLOB NOT NULL) STRICT;
CREATE INDEX jobs_by_session ON jobs (session);
CREATE TABLE loose (blob TEXT PRIMARY KEY) STRICT;  -- blobs that may have no session
CREATE TRIGGER session_goes AFTER DELETE ON sessions BEGIN
    DELETE FROM representations WHERE session = OLD.number;
    DELETE FROM jobs WHERE session = OLD.number;
    INSERT OR IGNORE INTO loose SELECT OLD.blob WHERE OLD.blob <> '';
END;
CREATE TRIGGER source_goes AFTER UPDATE OF blob ON sessions WHEN OLD.blob <> '' BEGIN
    INSERT OR IGNORE INTO loose VALUES (OLD.blob);
END;
CREATE TRIGGER session_comes AFTER INSERT ON sessions BEGIN
    DELETE FROM loose WHERE blob = NEW.blob;
END;
CREATE TRIGGER source_comes AFTER UPDATE OF blob ON sessions WHEN OLD.blob <> NEW.blob BEGIN
    DELETE FROM loose WHERE blob = NEW.blob;
END;
CREATE TRIGGER representation_comes AFTER INSERT ON representations BEGIN
    DELETE FROM loose WHERE blob = NEW.blob;
END;
CREATE TRIGGER representation_goes AFTER DELETE ON representations BEGIN
    INSERT OR IGNORE INTO loose VALUES (OLD.blob);
END;
PRAGMA user_version = 1;
)";

// What changes at every use has a digest of its own.
constexpr const char* kSecondStep = R"(
ALTER TABLE clock ADD COLUMN digest TEXT NOT NULL DEFAULT '';
ALTER TABLE sessions ADD COLUMN life TEXT NOT NULL DEFAULT '';  -- digest of number, expires and made
PRAGMA user_version = 2;
)";

constexpr const char* kThirdStep = R"(
ALTER TABLE jobs ADD COLUMN digest TEXT NOT NULL DEFAULT '';  -- of session and info
PRAGMA user_version = 3;
)";

constexpr std::array kSteps{kFirstStep, kSecondStep, kThirdStep};
constexpr auto kVersion = static_cast<std::int64_t>(kSteps.size());

Error no_session() { return {Cause::kNotFound, "the session was deleted in the meantime", "session"}; }

Expected<std::int64_t> one_number(Database& database, const char* sql) {
    Statement statement = database.prepare(sql);
    const Expected<bool> row = statement.step();
    if (!row) return row.error();
    return *row ? statement.number(0) : 0;
}

// "ok" where the database is sound.
Status check(Database& database) {
    Statement statement = database.prepare("PRAGMA integrity_check(1)");
    const Expected<bool> row = statement.step();
    if (!row) return row.error();
    const std::string told = *row ? statement.bytes(0) : "nothing";
    if (told == "ok") return Done{};
    return Error{Cause::kCorrupt, "the data directory's index: " + told, ""};
}

// The next session's number must be one.
Status check_last_number(Database& database) {
    constexpr std::int64_t kMost = std::int64_t{1} << 53;
    const Expected<std::int64_t> tables =
        one_number(database, "SELECT count(*) FROM sqlite_schema WHERE name = 'sqlite_sequence'");
    if (!tables) return tables.error();
    if (*tables == 0) return Done{};
    const Expected<std::int64_t> last = one_number(database, "SELECT max(seq) FROM sqlite_sequence");
    if (!last) return last.error();
    if (*last >= 0 && *last < kMost) return Done{};
    return Error{Cause::kCorrupt, "the data directory's index: the last number is " + std::to_string(*last), ""};
}

Expected<std::set<std::string>> schema_of(Database& database) {
    Statement rows = database.prepare(
        "SELECT type || ' ' || name || ' of ' || tbl_name || ': ' || sql FROM sqlite_schema WHERE name NOT LIKE 'sqlite_%'");
    std::set<std::string> schema;
    for (;;) {
        const Expected<bool> row = rows.step();
        if (!row) return row.error();
        if (!*row) return schema;
        schema.insert(rows.bytes(0));
    }
}

Expected<std::set<std::string>> our_schema() {
    Expected<Database> fresh = Database::open(":memory:");
    if (!fresh) return fresh.error();
    for (const char* step : kSteps) {
        if (Status taken = fresh->run(step); !taken) return taken.error();
    }
    return schema_of(*fresh);
}

// A bit that changes in the name of a column or in a trigger leaves a sound database, which works otherwise. What somebody has
// added is no damage.
Status check_schema(Database& database) {
    const Expected<std::set<std::string>> wanted = our_schema();
    if (!wanted) return wanted.error();
    const Expected<std::set<std::string>> found = schema_of(database);
    if (!found) return found.error();
    if (std::includes(found->begin(), found->end(), wanted->begin(), wanted->end())) return Done{};
    return Error{Cause::kCorrupt, "the data directory's index: its schema is not as it was written", ""};
}

bool has_only_our_schema(Database& database) {
    const Expected<std::set<std::string>> wanted = our_schema();
    const Expected<std::set<std::string>> found = schema_of(database);
    return wanted && found && *wanted == *found;
}

}  // namespace

Expected<std::unique_ptr<SqliteSessionIndex>> SqliteSessionIndex::open(const std::filesystem::path& file, bool writable) {
    Expected<Database> database = Database::open(file, writable);
    if (!database) return database.error();
    std::unique_ptr<SqliteSessionIndex> index(new SqliteSessionIndex(*std::move(database)));
    if (Status ready = index->prepare_schema(writable); !ready) return ready.error();
    return index;
}

Status SqliteSessionIndex::empty_log() {
    const std::lock_guard lock(mutex_);
    const Expected<std::int64_t> busy = one_number(database_, "PRAGMA wal_checkpoint(TRUNCATE)");
    if (!busy) return busy.error();
    if (*busy == 0) return Done{};
    return Error{Cause::kUnavailable, "the data directory's index is in use by another program", "data_dir"};
}

Status SqliteSessionIndex::prepare_schema(bool writable) {
    for (const char* setting : {"PRAGMA synchronous = FULL", "PRAGMA journal_mode = WAL", "PRAGMA wal_autocheckpoint = 100",
                                "PRAGMA journal_size_limit = 1000000"}) {
        if (!writable) break;
        if (Status set = database_.run(setting); !set) return set;
    }
    if (writable && !database_.writable())
        return Error{Cause::kCorrupt, "the data directory's index: its header says that it cannot be written", ""};
    if (Status sound = check(database_); !sound) return sound;
    if (Status number = check_last_number(database_); !number) return number;
    const Expected<std::int64_t> version = one_number(database_, "PRAGMA user_version");
    if (!version) return version.error();
    if (*version == kVersion) return check_schema(database_);
    // A later one has another schema; what has this very one and says otherwise is damaged.
    if (*version > kVersion && has_only_our_schema(database_))
        return Error{Cause::kCorrupt, "the data directory's index: it says that its version is " + std::to_string(*version), ""};
    if (*version > kVersion) {
        return Error{Cause::kUnsupported,
                     "the data directory's index has version " + std::to_string(*version) +
                         "; this vsplitd knows versions up to " + std::to_string(kVersion) + ", and a later one is needed",
                     "data_dir"};
    }
    const Expected<std::int64_t> tables = one_number(database_, "SELECT count(*) FROM sqlite_schema");
    if (!tables) return tables.error();
    if (*version < 0 || (*version == 0 && *tables != 0))
        return Error{Cause::kCorrupt, "the data directory's index: it has tables and no version", ""};
    if (Status taken = take_steps(*version); !taken) return taken;
    return check_schema(database_);
}

/// From the schema of an earlier version, or none.
Status SqliteSessionIndex::take_steps(std::int64_t version) {
    Transaction transaction(database_);
    if (Status begun = transaction.begin(); !begun) return begun;
    for (std::size_t step = static_cast<std::size_t>(version); step < kSteps.size(); ++step) {
        if (Status made = database_.run(kSteps[step]); !made) return made;
    }
    // Not more than has none: what is damaged is not to be taken for sound.
    if (Status done = version < 2 ? sign() : sign_jobs(); !done) return done;
    return transaction.commit();
}

/// Gives digests to what versions that had none have written. \pre a transaction is open.
Status SqliteSessionIndex::sign() {
    const Expected<std::int64_t> now = one_number(database_, "SELECT now FROM clock");
    if (!now) return now.error();
    if (Status set = set_clock(*now); !set) return set;
    std::vector<SessionRow> sessions;
    Statement rows = database_.prepare("SELECT number, expires, made FROM sessions");
    for (Expected<bool> row = rows.step(); !row || *row; row = rows.step()) {
        if (!row) return row.error();
        SessionRow& session = sessions.emplace_back();
        session.number = static_cast<std::uint64_t>(rows.number(0));
        session.expires = rows.number(1);
        session.made = static_cast<std::uint64_t>(rows.number(2));
    }
    for (const SessionRow& session : sessions) {
        if (Status set = set_life(session.number, session.expires, session.made); !set) return set;
    }
    return sign_jobs();
}

// \pre a transaction is open.
Status SqliteSessionIndex::sign_jobs() {
    std::vector<JobRow> jobs;
    Status read = load_rows("SELECT * FROM jobs", [&jobs](const Statement& row) { jobs.push_back(read_job(row)); });
    if (!read) return read;
    for (const JobRow& job : jobs) {
        const std::string digest = digest_of(job);
        Status set = database_.prepare("UPDATE jobs SET digest = ? WHERE number = ?").bind_text(digest).bind(job.number).run();
        if (!set) return set;
    }
    return Done{};
}

// Not an update, so that a row that was lost comes back. \pre a transaction is open.
Status SqliteSessionIndex::set_clock(std::int64_t now) {
    if (Status gone = database_.run("DELETE FROM clock"); !gone) return gone;
    const std::string digest = digest_of_clock(now);
    return database_.prepare("INSERT INTO clock (now, digest) VALUES (?, ?)").bind(now).bind_text(digest).run();
}

/// \pre lock held.
Status SqliteSessionIndex::set_life(std::uint64_t session, std::int64_t expires, std::uint64_t made) {
    const std::string life = life_of(session, expires, made);
    Statement update = database_.prepare("UPDATE sessions SET expires = ?, made = ?, life = ? WHERE number = ?");
    return update.bind(expires).bind(made).bind_text(life).bind(session).run();
}

Expected<IndexContents> SqliteSessionIndex::load() {
    const std::lock_guard lock(mutex_);
    IndexContents contents;
    const Expected<std::optional<std::int64_t>> now = read_clock(database_);
    if (!now) return now.error();
    contents.now = *now;
    const Expected<std::int64_t> last = one_number(database_, "SELECT seq FROM sqlite_sequence WHERE name = 'sessions'");
    if (!last) return last.error();
    contents.last_session = static_cast<std::uint64_t>(*last);
    Status loaded = load_rows("SELECT * FROM sessions ORDER BY number",
                              [&](const Statement& row) { contents.sessions.push_back(read_session(row)); });
    if (!loaded) return loaded.error();
    loaded = load_rows("SELECT * FROM representations ORDER BY session, number",
                       [&](const Statement& row) { contents.representations.push_back(read_representation_row(row)); });
    if (!loaded) return loaded.error();
    loaded =
        load_rows("SELECT * FROM jobs ORDER BY number", [&](const Statement& row) { contents.jobs.push_back(read_job(row)); });
    if (!loaded) return loaded.error();
    if (!contents.sessions.empty()) contents.last_session = std::max(contents.last_session, contents.sessions.back().number);
    return contents;
}

Status SqliteSessionIndex::load_rows(const char* sql, const std::function<void(const Statement&)>& take) {
    Statement rows = database_.prepare(sql);
    for (;;) {
        const Expected<bool> row = rows.step();
        if (!row) return row.error();
        if (!*row) return Done{};
        take(rows);
    }
}

Status SqliteSessionIndex::add_session(const SessionRow& session) {
    const std::lock_guard lock(mutex_);
    return insert(session);
}

// \pre lock held.
Status SqliteSessionIndex::insert(const SessionRow& session) {
    const std::string digest = digest_of(session);
    const std::string life = life_of(session.number, session.expires, session.made);
    return database_.prepare("INSERT INTO sessions VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, NULL, ?)")
        .bind(session.number)
        .bind_text(session.id)
        .bind_text(session.owner)
        .bind(session.created)
        .bind(session.expires)
        .bind(session.made)
        .bind_text(session.source.blob)
        .bind_blob(session.source.info)
        .bind_text(digest)
        .bind_text(life)
        .run();
}

// \pre lock held.
Status SqliteSessionIndex::insert(const RepresentationRow& representation) {
    const std::string digest = digest_of(representation);
    return database_.prepare("INSERT INTO representations VALUES (?, ?, ?, ?, ?)")
        .bind(representation.session)
        .bind(representation.number)
        .bind_text(representation.item.blob)
        .bind_blob(representation.item.info)
        .bind_text(digest)
        .run();
}

// Nothing where there is no such session. \pre lock held.
Status SqliteSessionIndex::insert(const JobRow& job) {
    const std::string digest = digest_of(job);
    return database_.prepare("INSERT INTO jobs (session, info, digest) SELECT number, ?, ? FROM sessions WHERE number = ?")
        .bind_blob(job.info)
        .bind_text(digest)
        .bind(job.session)
        .run();
}

Status SqliteSessionIndex::take_over(const IndexContents& contents) {
    const std::lock_guard lock(mutex_);
    Transaction transaction(database_);
    if (Status begun = transaction.begin(); !begun) return begun;
    for (const SessionRow& session : contents.sessions) {
        if (Status added = insert(session); !added) return added;
    }
    for (const RepresentationRow& representation : contents.representations) {
        if (Status added = insert(representation); !added) return added;
    }
    for (const JobRow& row : contents.jobs) {
        if (Status added = insert(row); !added) return added;
    }
    Status clock = contents.now ? set_clock(*contents.now) : database_.run("DELETE FROM clock");
    if (!clock) return clock;
    return transaction.commit();
}

/// What the digest is of, but for the source. \pre lock held.
Expected<SessionRow> SqliteSessionIndex::find_session(std::uint64_t number) {
    Statement row = database_.prepare("SELECT id, owner, created FROM sessions WHERE number = ?");
    const Expected<bool> found = row.bind(number).step();
    if (!found) return found.error();
    if (!*found) return no_session();
    SessionRow session;
    session.number = number;
    session.id = row.bytes(0);
    session.owner = row.bytes(1);
    session.created = row.number(2);
    return session;
}

Status SqliteSessionIndex::set_source(std::uint64_t session, const StoredItem& source) {
    const std::lock_guard lock(mutex_);
    Transaction transaction(database_);
    if (Status begun = transaction.begin(); !begun) return begun;
    Expected<SessionRow> row = find_session(session);
    if (!row) return row.error();
    row->source = source;
    const std::string digest = digest_of(*row);
    Statement update = database_.prepare("UPDATE sessions SET blob = ?, info = ?, digest = ? WHERE number = ?");
    update.bind_text(source.blob).bind_blob(source.info).bind_text(digest).bind(session);
    if (Status done = update.run(); !done) return done;
    if (Status done = database_.prepare("DELETE FROM representations WHERE session = ?").bind(session).run(); !done) return done;
    if (Status done = database_.prepare("DELETE FROM jobs WHERE session = ?").bind(session).run(); !done) return done;
    return transaction.commit();
}

Status SqliteSessionIndex::add_representation(const RepresentationRow& representation, std::uint64_t made) {
    const std::lock_guard lock(mutex_);
    Transaction transaction(database_);
    if (Status begun = transaction.begin(); !begun) return begun;
    Statement row = database_.prepare("SELECT expires FROM sessions WHERE number = ?");
    const Expected<bool> found = row.bind(representation.session).step();
    if (!found) return found.error();
    if (!*found) return no_session();
    if (Status set = set_life(representation.session, row.number(0), made); !set) return set;
    if (Status done = insert(representation); !done) return done;
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
    if (Status done = set_clock(now); !done) return done;
    Statement row = database_.prepare("SELECT made FROM sessions WHERE number = ?");
    for (const auto& [session, time] : expire) {
        const Expected<bool> found = row.bind(session).step();
        if (!found) return found.error();
        const auto made = *found ? static_cast<std::uint64_t>(row.number(0)) : 0;
        row.reset();
        if (Status done = set_life(session, time, made); !done) return done;
    }
    return transaction.commit();
}

Expected<std::uint64_t> SqliteSessionIndex::add_job(std::uint64_t session, const std::string& info) {
    const std::lock_guard lock(mutex_);
    if (Status done = insert(JobRow{0, session, info}); !done) return done.error();
    if (database_.changes() == 0) return no_session();
    return database_.last_row();
}

Status SqliteSessionIndex::remove_jobs(const std::vector<std::uint64_t>& jobs) {
    const std::lock_guard lock(mutex_);
    return for_each("DELETE FROM jobs WHERE number = ?", jobs);
}

Status SqliteSessionIndex::set_aside(std::uint64_t session, const std::string& why) {
    const std::lock_guard lock(mutex_);
    return database_.prepare("UPDATE sessions SET damage = nullif(?, '') WHERE number = ?").bind_text(why).bind(session).run();
}

Status SqliteSessionIndex::add_loose(const std::string& blob) {
    const std::lock_guard lock(mutex_);
    return database_.prepare("INSERT OR IGNORE INTO loose VALUES (?)").bind_text(blob).run();
}

Expected<std::vector<std::string>> SqliteSessionIndex::loose() {
    const std::lock_guard lock(mutex_);
    Statement rows = database_.prepare(
        "SELECT blob FROM loose WHERE blob NOT IN (SELECT blob FROM sessions) AND blob NOT IN (SELECT blob FROM "
        "representations)");
    std::vector<std::string> blobs;
    for (;;) {
        const Expected<bool> row = rows.step();
        if (!row) return row.error();
        if (!*row) return blobs;
        blobs.push_back(rows.bytes(0));
    }
}

Status SqliteSessionIndex::remove_loose(const std::vector<std::string>& blobs) {
    const std::lock_guard lock(mutex_);
    Transaction transaction(database_);
    if (Status begun = transaction.begin(); !begun) return begun;
    Statement statement = database_.prepare("DELETE FROM loose WHERE blob = ?");
    for (const std::string& blob : blobs) {
        if (Status done = statement.bind_text(blob).run(); !done) return done;
    }
    return transaction.commit();
}

Expected<std::vector<std::string>> SqliteSessionIndex::unknown(const std::vector<std::string>& blobs) {
    const std::lock_guard lock(mutex_);
    Statement statement = database_.prepare(
        "SELECT ?1 IN (SELECT blob FROM sessions) OR ?1 IN (SELECT blob FROM representations) OR ?1 IN (SELECT blob FROM loose)");
    std::vector<std::string> unknown;
    for (const std::string& blob : blobs) {
        const Expected<bool> row = statement.bind_text(blob).step();
        if (!row) return row.error();
        if (statement.number(0) == 0) unknown.push_back(blob);
        statement.reset();
    }
    return unknown;
}

}  // namespace vsplit::store

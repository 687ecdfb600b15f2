#include "store/sqlite.h"

#include <sys/stat.h>

#include <cerrno>
#include <system_error>

#include "service/limits.h"

namespace vsplit::store {

namespace {

// An operator who looks with another program may hold it for a moment.
constexpr int kBusyMilliseconds = 5000;

bool has_log(const std::filesystem::path& file) {
    std::filesystem::path log = file;
    log += "-wal";
    std::error_code unknown;
    return std::filesystem::exists(log, unknown);
}

// Whether the last call failed for want of room.
bool is_full(sqlite3* handle) {
    const int code = sqlite3_errcode(handle);
    if (code == SQLITE_FULL) return true;
    const int number = sqlite3_system_errno(handle);
    return (code == SQLITE_IOERR || code == SQLITE_CANTOPEN) && (number == ENOSPC || number == EDQUOT);
}

// A database that nobody writes to can be read where not even locks can be written: DataDir holds one for it.
std::string address_of(const std::filesystem::path& file, bool writable) {
    if (writable) return file.string();
    std::string address = "file:";
    for (const char c : file.string()) {
        constexpr std::string_view kSpecial = "%?#";
        if (kSpecial.find(c) == std::string_view::npos) {
            address += c;
        } else {
            address += c == '%' ? "%25" : c == '?' ? "%3f" : "%23";
        }
    }
    return address + (has_log(file) ? "?vfs=unix-none" : "?immutable=1");
}

}  // namespace

Expected<Database> Database::open(const std::filesystem::path& file, bool writable) {
    sqlite3* handle = nullptr;
    // One connection, guarded by its owner.
    const int access = writable ? SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE : SQLITE_OPEN_READONLY | SQLITE_OPEN_URI;
    const int result = sqlite3_open_v2(address_of(file, writable).c_str(), &handle, access | SQLITE_OPEN_NOMUTEX, nullptr);
    Database database(handle);
    if (handle == nullptr) return Error{Cause::kLimitExceeded, "no memory to open " + file.string(), ""};
    if (result != SQLITE_OK) return database.error();
    sqlite3_busy_timeout(handle, kBusyMilliseconds);
    if (writable) return database;
    // The index of its log is kept in memory then, not in a file beside it.
    if (Status alone = database.run("PRAGMA locking_mode = EXCLUSIVE"); !alone) return alone.error();
    return database;
}

Status Database::run(const char* sql) {
    if (sqlite3_exec(handle_.get(), sql, nullptr, nullptr, nullptr) == SQLITE_OK) return Done{};
    return error();
}

Statement Database::prepare(const char* sql) {
    sqlite3_stmt* statement = nullptr;
    sqlite3_prepare_v2(handle_.get(), sql, -1, &statement, nullptr);
    return {*this, statement};
}

bool Database::moved() {
    int moved = 0;
    if (sqlite3_file_control(handle_.get(), "main", SQLITE_FCNTL_HAS_MOVED, &moved) == SQLITE_OK && moved != 0) return true;
    // SQLite does not look after its log, which is there from the first change on, for as long as the database is open.
    const char* const file = sqlite3_db_filename(handle_.get(), "main");
    struct stat log {};
    const bool there = file != nullptr && *file != '\0' && stat((std::string(file) + "-wal").c_str(), &log) == 0;
    if (there && !log_) log_ = log.st_ino;
    return log_ && (!there || *log_ != log.st_ino);
}

Error Database::error() const {
    const std::string message = sqlite3_errmsg(handle_.get());
    if (is_full(handle_.get())) {
        return {Cause::kLimitExceeded, "the disk of the data directory is full (its index: " + message + ")", "",
                service::kRetryAfter};
    }
    switch (sqlite3_errcode(handle_.get())) {
        case SQLITE_CORRUPT:
        case SQLITE_NOTADB:
        case SQLITE_ERROR:       // what the schema does not know, though it should
        case SQLITE_CONSTRAINT:  // what contradicts it
            return {Cause::kCorrupt, "the data directory's index: " + message, ""};
        default:
            return {Cause::kUnavailable, "the data directory's index: " + message, "", service::kRetryAfter};
    }
}

Statement& Statement::bind(std::uint64_t value) { return bind(static_cast<std::int64_t>(value)); }

Statement& Statement::bind(std::int64_t value) {
    sqlite3_bind_int64(handle_.get(), ++bound_, value);
    return *this;
}

// What is bound outlives the statement's run: callers step before they return.
Statement& Statement::bind_text(std::string_view value) {
    sqlite3_bind_text64(handle_.get(), ++bound_, value.data(), value.size(), SQLITE_STATIC, SQLITE_UTF8);
    return *this;
}

Statement& Statement::bind_blob(std::string_view value) {
    sqlite3_bind_blob64(handle_.get(), ++bound_, value.data(), value.size(), SQLITE_STATIC);
    return *this;
}

Statement& Statement::bind_null() {
    sqlite3_bind_null(handle_.get(), ++bound_);
    return *this;
}

Expected<bool> Statement::step() {
    if (!handle_) return database_->error();
    switch (sqlite3_step(handle_.get())) {
        case SQLITE_ROW:
            return true;
        case SQLITE_DONE:
            return false;
        default:
            return database_->error();
    }
}

Status Statement::run() {
    if (database_->moved()) {
        reset();
        return Error{
            Cause::kUnavailable,
            "the data directory's index was moved or deleted while the server runs; nothing is kept until the server starts anew",
            ""};
    }
    const Expected<bool> row = step();
    reset();
    if (!row) return row.error();
    return Done{};
}

void Statement::reset() {
    sqlite3_reset(handle_.get());
    bound_ = 0;
}

std::string Statement::bytes(int column) const {
    const void* const data = sqlite3_column_blob(handle_.get(), column);
    const auto size = static_cast<std::size_t>(sqlite3_column_bytes(handle_.get(), column));
    return data == nullptr ? std::string() : std::string(static_cast<const char*>(data), size);
}

Transaction::~Transaction() {
    if (open_) static_cast<void>(database_.run("ROLLBACK"));
}

Status Transaction::begin() {
    Status begun = database_.run("BEGIN IMMEDIATE");
    open_ = begun.has_value();
    return begun;
}

Status Transaction::commit() {
    if (Status committed = database_.run("COMMIT"); !committed) return committed;
    open_ = false;
    return Done{};
}

}  // namespace vsplit::store

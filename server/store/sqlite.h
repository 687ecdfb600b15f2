#pragma once

#include <sqlite3.h>
#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "vsplit/base/expected.h"

namespace vsplit::store {

class Statement;

/// A connection to an SQLite database. Not thread-safe.
class Database {
public:
    /// Made if need be, unless it is to be read only. \return CORRUPT for a file that is no database, UNAVAILABLE.
    [[nodiscard]] static Expected<Database> open(const std::filesystem::path& file, bool writable = true);

    /// \return as `error`.
    [[nodiscard]] Status run(const char* sql);

    /// \pre `sql` is well formed; a statement that the schema does not know is CORRUPT when it is stepped.
    [[nodiscard]] Statement prepare(const char* sql);

    [[nodiscard]] std::uint64_t last_row() const { return static_cast<std::uint64_t>(sqlite3_last_insert_rowid(handle_.get())); }
    [[nodiscard]] int changes() const { return sqlite3_changes(handle_.get()); }

    /// Whether it can be written: its file may be read-only, or its header say so.
    [[nodiscard]] bool writable() const { return sqlite3_db_readonly(handle_.get(), "main") == 0; }

    /// Whether its file, or its log, is no longer in its place: what is written then is lost with the process.
    [[nodiscard]] bool moved();

    /// What went wrong last: LIMIT_EXCEEDED (the disk is full), CORRUPT, UNAVAILABLE.
    [[nodiscard]] Error error() const;

private:
    struct Close {
        void operator()(sqlite3* handle) const { sqlite3_close_v2(handle); }
    };

    explicit Database(sqlite3* handle) : handle_(handle) {}

    std::unique_ptr<sqlite3, Close> handle_;
    std::optional<ino_t> log_;
};

/// A prepared statement: parameters are bound from the first on, columns are read by number from 0.
class Statement {
public:
    Statement(Database& database, sqlite3_stmt* handle) : database_(&database), handle_(handle) {}

    Statement& bind(std::uint64_t value);
    Statement& bind(std::int64_t value);
    Statement& bind_text(std::string_view value);
    Statement& bind_blob(std::string_view value);
    Statement& bind_null();

    /// The next row: whether there is one. \return as Database::error.
    [[nodiscard]] Expected<bool> step();

    /// For one that gives no rows. \return as Database::error; UNAVAILABLE where the database was moved.
    [[nodiscard]] Status run();

    /// Ready to be bound and run again.
    void reset();

    [[nodiscard]] std::int64_t number(int column) const { return sqlite3_column_int64(handle_.get(), column); }
    [[nodiscard]] std::string bytes(int column) const;

private:
    struct Finalize {
        void operator()(sqlite3_stmt* handle) const { sqlite3_finalize(handle); }
    };

    Database* database_;
    std::unique_ptr<sqlite3_stmt, Finalize> handle_;
    int bound_ = 0;
};

/// All that is done until `commit`, or nothing.
class Transaction {
public:
    explicit Transaction(Database& database) : database_(database) {}
    ~Transaction();
    Transaction(const Transaction&) = delete;
    Transaction& operator=(const Transaction&) = delete;

    [[nodiscard]] Status begin();
    [[nodiscard]] Status commit();

private:
    Database& database_;
    bool open_ = false;
};

}  // namespace vsplit::store

#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>

#include "store/session_index.h"
#include "store/sqlite.h"

namespace vsplit::store {

/// The index as an SQLite database with a write-ahead log, synchronised at each commit.
class SqliteSessionIndex final : public SessionIndex {
public:
    /// Makes the database if need be; one that is not `writable` is left as it is, and whatever would write fails.
    /// \return CORRUPT for one that is damaged, UNSUPPORTED for one of a later version, UNAVAILABLE, LIMIT_EXCEEDED.
    [[nodiscard]] static Expected<std::unique_ptr<SqliteSessionIndex>> open(const std::filesystem::path& file,
                                                                            bool writable = true);

    /// All of another index into this one, which is empty; without a clock where there is none. \return as SessionIndex says.
    [[nodiscard]] Status take_over(const IndexContents& contents);

    /// Whatever is in the log goes into the database, and the log is empty. \return as SessionIndex says.
    [[nodiscard]] Status empty_log();

    [[nodiscard]] Expected<IndexContents> load() override;
    [[nodiscard]] Status add_session(const SessionRow& session) override;
    [[nodiscard]] Status set_source(std::uint64_t session, const StoredItem& source) override;
    [[nodiscard]] Status add_representation(const RepresentationRow& representation, std::uint64_t made) override;
    [[nodiscard]] Status remove_sessions(const std::vector<std::uint64_t>& sessions) override;
    [[nodiscard]] Status note_time(std::int64_t now, const std::vector<std::pair<std::uint64_t, std::int64_t>>& expire) override;
    [[nodiscard]] Expected<std::uint64_t> add_job(std::uint64_t session, const std::string& info) override;
    [[nodiscard]] Status remove_jobs(const std::vector<std::uint64_t>& jobs) override;
    [[nodiscard]] Status set_aside(std::uint64_t session, const std::string& why) override;
    [[nodiscard]] Status add_loose(const std::string& blob) override;
    [[nodiscard]] Expected<std::vector<std::string>> loose() override;
    [[nodiscard]] Status remove_loose(const std::vector<std::string>& blobs) override;
    [[nodiscard]] Expected<std::vector<std::string>> unknown(const std::vector<std::string>& blobs) override;

private:
    explicit SqliteSessionIndex(Database database) : database_(std::move(database)) {}

    [[nodiscard]] Status prepare_schema(bool writable);
    [[nodiscard]] Status take_steps(std::int64_t version);
    [[nodiscard]] Status sign();
    [[nodiscard]] Status sign_jobs();
    [[nodiscard]] Status set_clock(std::int64_t now);
    [[nodiscard]] Status set_life(std::uint64_t session, std::int64_t expires, std::uint64_t made);
    [[nodiscard]] Status load_rows(const char* sql, const std::function<void(const Statement&)>& take);
    [[nodiscard]] Status insert(const SessionRow& session);
    [[nodiscard]] Status insert(const RepresentationRow& representation);
    [[nodiscard]] Status insert(const JobRow& job);
    [[nodiscard]] Expected<SessionRow> find_session(std::uint64_t number);
    [[nodiscard]] Status for_each(const char* sql, const std::vector<std::uint64_t>& numbers);

    std::mutex mutex_;
    Database database_;
};

}  // namespace vsplit::store

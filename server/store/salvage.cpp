#include "store/salvage.h"

#include <map>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "store/first_page.h"
#include "store/index_rows.h"
#include "store/new_index.h"
#include "store/sqlite.h"

namespace vsplit::store {
namespace {

/// The index as it is, and with a new first page, as far as each can be opened.
class Readings {
public:
    Readings(const std::filesystem::path& index, const std::filesystem::path& copy) : copy_(copy) {
        add(index);
        if (copy_with_new_first_page(index, copy)) add(copy);
    }
    ~Readings() {
        databases_.clear();
        std::error_code left;
        remove_index(copy_, left);
    }
    Readings(const Readings&) = delete;
    Readings& operator=(const Readings&) = delete;

    /// Sound rows, by what `key_of` says of them. Indices, which may be what is damaged, are not used.
    template <class Read, class Key>
    auto table(const std::string& name, const Read& read, const Key& key_of) {
        std::map<decltype(key_of(read(std::declval<const Statement&>()))), decltype(read(std::declval<const Statement&>()))>
            found;
        for (Database& database : databases_) {
            for (const char* order : {"ASC", "DESC"}) {
                Statement rows = database.prepare(("SELECT * FROM " + name + " NOT INDEXED ORDER BY rowid " + order).c_str());
                Expected<bool> row = rows.step();
                for (; row && *row; row = rows.step()) {
                    auto value = read(rows);
                    if constexpr (requires { value.sound; }) {
                        if (!value.sound) continue;
                    }
                    auto key = key_of(value);
                    found.try_emplace(std::move(key), std::move(value));
                }
                if (row) break;  // nothing is in the way
            }
        }
        return found;
    }

    std::optional<std::int64_t> clock() {
        for (Database& database : databases_) {
            const Expected<std::optional<std::int64_t>> now = read_clock(database);
            if (now && *now) return *now;
        }
        return std::nullopt;
    }

private:
    void add(const std::filesystem::path& file) {
        Expected<Database> database = Database::open(file, false);
        if (!database) return;
        static_cast<void>(database->run("PRAGMA writable_schema = ON"));  // what of the schema cannot be read is passed over
        databases_.push_back(*std::move(database));
    }

    std::filesystem::path copy_;
    std::vector<Database> databases_;
};

}  // namespace

IndexContents salvage(const std::filesystem::path& index, const std::filesystem::path& copy) {
    Readings readings(index, copy);
    IndexContents contents;
    const auto sessions = readings.table("sessions", read_session, [](const SessionRow& row) { return row.number; });
    for (const auto& [number, session] : sessions) contents.sessions.push_back(session);
    const auto key_of = [](const RepresentationRow& row) { return std::pair(row.session, row.number); };
    for (const auto& [key, made] : readings.table("representations", read_representation_row, key_of)) {
        if (sessions.contains(made.session)) contents.representations.push_back(made);
    }
    for (const auto& [number, job] : readings.table("jobs", read_job, [](const JobRow& row) { return row.number; })) {
        if (sessions.contains(job.session)) contents.jobs.push_back(job);
    }
    contents.now = readings.clock();
    return contents;
}

}  // namespace vsplit::store

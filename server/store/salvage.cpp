#include "store/salvage.h"

#include <map>
#include <string>
#include <utility>

#include "store/index_rows.h"
#include "store/sqlite.h"

namespace vsplit::store {
namespace {

/// By what `key_of` says of a row. Indices, which may be what is damaged, are not used.
template <class Read, class Key>
auto read_table(Database& database, const std::string& table, const Read& read, const Key& key_of) {
    std::map<decltype(key_of(read(std::declval<const Statement&>()))), decltype(read(std::declval<const Statement&>()))> found;
    for (const char* order : {"ASC", "DESC"}) {
        Statement rows = database.prepare(("SELECT * FROM " + table + " NOT INDEXED ORDER BY rowid " + order).c_str());
        Expected<bool> row = rows.step();
        for (; row && *row; row = rows.step()) {
            auto value = read(rows);
            found.try_emplace(key_of(value), std::move(value));
        }
        if (row) break;  // nothing is in the way
    }
    return found;
}

}  // namespace

IndexContents salvage(const std::filesystem::path& index) {
    IndexContents contents;
    Expected<Database> database = Database::open(index, false);
    if (!database) return contents;
    static_cast<void>(database->run("PRAGMA writable_schema = ON"));  // what of the schema cannot be read is passed over
    const auto sessions = read_table(*database, "sessions", read_session, [](const SessionRow& row) { return row.number; });
    for (const auto& [number, session] : sessions) {
        if (session.sound) contents.sessions.push_back(session);
    }
    const auto is_whole = [&sessions](std::uint64_t number) {
        const auto session = sessions.find(number);
        return session != sessions.end() && session->second.sound;
    };
    const auto key_of = [](const RepresentationRow& row) { return std::pair(row.session, row.number); };
    for (const auto& [key, made] : read_table(*database, "representations", read_representation_row, key_of)) {
        if (made.sound && is_whole(made.session)) contents.representations.push_back(made);
    }
    for (const auto& [number, job] : read_table(*database, "jobs", read_job, [](const JobRow& row) { return row.number; })) {
        if (is_whole(job.session)) contents.jobs.push_back(job);
    }
    const Expected<std::optional<std::int64_t>> now = read_clock(*database);
    if (now) contents.now = *now;
    return contents;
}

}  // namespace vsplit::store

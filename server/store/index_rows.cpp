#include "store/index_rows.h"

#include <initializer_list>
#include <string_view>

#include "guard/digest.h"

namespace vsplit::store {
namespace {

// Lengths keep fields apart.
std::string digest_of(std::initializer_list<std::string_view> fields) {
    std::string all;
    for (const std::string_view field : fields) all += std::to_string(field.size()) + ':' + std::string(field);
    return guard::hex_digits(guard::digest_of(all));
}

std::uint64_t count_at(const Statement& row, int column) { return static_cast<std::uint64_t>(row.number(column)); }

}  // namespace

std::string digest_of(const SessionRow& row) {
    return digest_of(
        {std::to_string(row.number), row.id, row.owner, std::to_string(row.created), row.source.blob, row.source.info});
}

std::string digest_of(const RepresentationRow& row) {
    return digest_of({std::to_string(row.session), std::to_string(row.number), row.item.blob, row.item.info});
}

// Its number follows from its place.
std::string digest_of(const JobRow& row) { return digest_of({"job", std::to_string(row.session), row.info}); }

std::string life_of(std::uint64_t number, std::int64_t expires, std::uint64_t made) {
    return digest_of({"life", std::to_string(number), std::to_string(expires), std::to_string(made)});
}

std::string digest_of_clock(std::int64_t now) { return digest_of({"clock", std::to_string(now)}); }

SessionRow read_session(const Statement& row) {
    SessionRow session;
    session.number = count_at(row, 0);
    session.id = row.bytes(1);
    session.owner = row.bytes(2);
    session.created = row.number(3);
    session.expires = row.number(4);
    session.made = count_at(row, 5);
    session.source = {row.bytes(6), row.bytes(7)};
    session.set_aside = !row.bytes(9).empty();
    session.sound = digest_of(session) == row.bytes(8) && life_of(session.number, session.expires, session.made) == row.bytes(10);
    return session;
}

RepresentationRow read_representation_row(const Statement& row) {
    RepresentationRow made;
    made.session = count_at(row, 0);
    made.number = count_at(row, 1);
    made.item = {row.bytes(2), row.bytes(3)};
    made.sound = digest_of(made) == row.bytes(4);
    return made;
}

JobRow read_job(const Statement& row) {
    JobRow job{count_at(row, 0), count_at(row, 1), row.bytes(2)};
    job.sound = digest_of(job) == row.bytes(3);
    return job;
}

Expected<std::optional<std::int64_t>> read_clock(Database& database) {
    Statement clock = database.prepare("SELECT * FROM clock");
    const Expected<bool> row = clock.step();
    if (!row) return row.error();
    if (*row && clock.bytes(1) == digest_of_clock(clock.number(0))) return std::optional(clock.number(0));
    return std::optional<std::int64_t>();
}

}  // namespace vsplit::store

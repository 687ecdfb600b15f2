#pragma once

#include <cstdint>
#include <string>

#include "store/session_index.h"
#include "store/sqlite.h"

namespace vsplit::store {

// Rows of the index have digests, so that bits that change in the file are seen. Columns are read by place, as `SELECT *` has
// them: a name that changed in a damaged schema hides nothing.

[[nodiscard]] std::string digest_of(const SessionRow& row);
[[nodiscard]] std::string digest_of(const RepresentationRow& row);
[[nodiscard]] std::string digest_of(const JobRow& row);

/// Of what changes at every use of a session.
[[nodiscard]] std::string life_of(std::uint64_t number, std::int64_t expires, std::uint64_t made);

[[nodiscard]] std::string digest_of_clock(std::int64_t now);

[[nodiscard]] SessionRow read_session(const Statement& row);
[[nodiscard]] RepresentationRow read_representation_row(const Statement& row);
[[nodiscard]] JobRow read_job(const Statement& row);

/// Empty where it is not as it was written, or not there.
[[nodiscard]] Expected<std::optional<std::int64_t>> read_clock(Database& database);

}  // namespace vsplit::store

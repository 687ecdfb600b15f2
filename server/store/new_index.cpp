#include "store/new_index.h"

#include <string>
#include <system_error>

#include "service/disk_error.h"
#include "store/damage.h"
#include "store/sqlite_session_index.h"
#include "store/sync_directory.h"

namespace vsplit::store {
namespace {

namespace fs = std::filesystem;

// One that is being made, and one that is whole: from then on the old one is done with.
constexpr const char* kBegun = "sessions.db.new";
constexpr const char* kReady = "sessions.db.ready";

Status failure(const std::error_code& failed) {
    return service::disk_error("cannot put a new index in the place of the damaged one", failed.value());
}

}  // namespace

void remove_index(const fs::path& index, std::error_code& failed) {
    for (const char* suffix : {"-wal", "-shm", ""}) {
        if (!failed) fs::remove(index.string() + suffix, failed);
    }
}

Status make_index(const fs::path& place, const IndexContents& contents) {
    {
        Expected<std::unique_ptr<SqliteSessionIndex>> index = SqliteSessionIndex::open(place);
        if (!index) return index.error();
        if (Status taken = (*index)->take_over(contents); !taken) return taken;
        if (Status emptied = (*index)->empty_log(); !emptied) return emptied;
    }
    std::error_code failed;
    for (const char* suffix : {"-wal", "-shm"}) {
        if (!failed) fs::remove(place.string() + suffix, failed);
    }
    return failed ? failure(failed) : Status(Done{});
}

Status replace_index(const fs::path& directory, const IndexContents& contents) {
    std::error_code failed;
    remove_index(directory / kBegun, failed);
    if (failed) return failure(failed);
    if (Status made = make_index(directory / kBegun, contents); !made) {
        remove_index(directory / kBegun, failed);
        return made;
    }
    fs::rename(directory / kBegun, directory / kReady, failed);
    if (failed) return failure(failed);
    if (!sync_directory(directory)) return service::disk_error("cannot keep a new index");
    return finish_replacement(directory);
}

Status finish_replacement(const fs::path& directory) {
    std::error_code failed;
    if (!fs::exists(directory / kReady, failed)) return failed ? failure(failed) : Status(Done{});
    // Its log must not be taken for the new one's.
    remove_index(directory / kIndexName, failed);
    if (!failed) fs::rename(directory / kReady, directory / kIndexName, failed);
    if (failed) return failure(failed);
    if (!sync_directory(directory)) return service::disk_error("cannot keep a new index");
    return Done{};
}

}  // namespace vsplit::store

#include "store/data_dir.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <fstream>
#include <iterator>
#include <span>
#include <string>
#include <system_error>
#include <utility>

#include "service/disk_error.h"
#include "store/damage.h"
#include "store/disk_reserve.h"
#include "store/file_blob_store.h"
#include "store/new_index.h"
#include "store/salvage.h"
#include "store/sqlite_session_index.h"
#include "store/stored_sessions.h"
#include "store/wal_check.h"

namespace vsplit::store {
namespace {

namespace fs = std::filesystem;

constexpr const char* kReserveName = "reserve";

/// Whether what is there is of the kind that it should be. What is not there is.
Status require_kinds(const fs::path& directory) {
    for (const std::string& name : {std::string(), std::string(kIndexName), std::string(kBlobsName),
                                    kBlobsName + std::string("/incoming"), std::string("uploads"), std::string(kReserveName)}) {
        const fs::path path = name.empty() ? directory : directory / name;
        const bool file = name == kIndexName || name == kReserveName;
        std::error_code failed;
        const fs::file_type type = fs::status(path, failed).type();
        if (type == fs::file_type::not_found || type == (file ? fs::file_type::regular : fs::file_type::directory)) continue;
        if (failed) return service::disk_error("cannot look at " + path.string(), failed.value());
        return Error{Cause::kInvalidOption,
                     path.string() + " is not a " + (file ? "file" : "directory") + ", as vsplitd needs it; move it away",
                     "data_dir"};
    }
    return Done{};
}

/// For its owner alone, where it is made; one that is there is somebody's decision.
Status make_directories(const fs::path& directory) {
    std::error_code failed;
    const bool made = fs::create_directories(directory, failed);
    if (made && !failed) fs::permissions(directory, fs::perms::owner_all, failed);
    if (!failed) fs::create_directories(directory / "uploads", failed);
    if (failed) return service::disk_error("cannot make " + directory.string(), failed.value());
    return Done{};
}

/// The descriptor that holds the lock, which is the directory's own, so that no file is to be kept for it. The system lets go of
/// it with the process, however that ends.
Expected<int> lock(const fs::path& directory) {
    const int descriptor = ::open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor < 0) return service::disk_error("cannot open " + directory.string());
    if (flock(descriptor, LOCK_EX | LOCK_NB) == 0) return descriptor;
    const int number = errno;
    close(descriptor);
    if (number != EWOULDBLOCK) return service::disk_error("cannot lock " + directory.string(), number);
    return Error{Cause::kInvalidOption,
                 directory.string() + " is the data directory of another vsplitd that runs; use another one", "data_dir"};
}

bool is_open_to_others(const fs::path& directory) {
    std::error_code unknown;
    const fs::perms others = fs::perms::others_read | fs::perms::others_exec;
    return (fs::status(directory, unknown).permissions() & others) == others;
}

std::uint64_t size_of(const fs::path& file) {
    std::error_code missing;
    const std::uint64_t size = fs::file_size(file, missing);
    return missing ? 0 : size;
}

// SQLite makes this file anew, and opens one that it may not write for reading only. \pre the lock is held
void remove_unusable_shared(const fs::path& index) {
    const fs::path shared = index.string() + "-shm";
    std::error_code ignored;
    if (fs::exists(shared, ignored) && access(shared.c_str(), W_OK) != 0) fs::remove(shared, ignored);
}

fs::path log_of(const fs::path& index) { return index.string() + "-wal"; }

std::string read_file(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

/// SQLite deletes the log of a database that is not there, and reads another one up to what is damaged, both in silence. What it
/// would lose is kept and told first.
/// \return whether what is read of the log goes on being used.
Expected<bool> look_over(const fs::path& directory, bool writable, const Report& report) {
    const fs::path index = directory / kIndexName;
    if (size_of(log_of(index)) == 0) return false;
    const bool lost = size_of(index) == 0;
    const std::string log = lost ? "" : read_file(log_of(index));
    const std::uint64_t passed_over = transactions_lost(std::as_bytes(std::span(log)));
    if (!lost && passed_over == 0) return false;
    const std::string what = lost ? "the data directory's index is missing or empty, and its log is not"
                                  : "the log of the data directory's index is damaged; what at least " +
                                        std::to_string(passed_over) + " changes behind the damage did is lost";
    if (!writable) {
        report(what);
        return false;
    }
    const Expected<fs::path> kept = keep_damaged(directory, lost ? Original::kGoes : Original::kIsUsed);
    if (!kept) return kept.error();
    report(what + "; " + (lost ? "put aside untouched in " : "kept as it was in ") + kept->string() +
           (lost ? ", and begun anew without its sessions" : ""));
    return !lost;
}

/// In the place of an index that is damaged, with what is sound of it.
Expected<std::unique_ptr<SqliteSessionIndex>> begin_anew(const fs::path& directory, const Error& damage, const Report& report) {
    const Expected<fs::path> aside = keep_damaged(directory, Original::kIsReplaced);
    if (!aside) return aside.error();
    const IndexContents sound = salvage(*aside / kIndexName, directory / "sessions.db.copy");
    if (Status replaced = replace_index(directory, sound); !replaced) return replaced.error();
    report(damage.message + "; put aside untouched in " + aside->string() +
           ", and begun anew with what is sound of it: " + std::to_string(sound.sessions.size()) + " sessions with " +
           std::to_string(sound.representations.size()) + " representations");
    return SqliteSessionIndex::open(directory / kIndexName);
}

}  // namespace

Expected<DataDir> DataDir::open(const fs::path& directory, std::uint64_t quota, const Report& report) {
    std::error_code unknown;
    const bool has_index = fs::exists(directory / kIndexName, unknown);
    if (unknown) return service::disk_error("cannot look into the data directory " + directory.string(), unknown.value());
    const bool writable =
        !has_index || (access(directory.c_str(), W_OK) == 0 && access((directory / kIndexName).c_str(), W_OK) == 0);
    const Error unwritable =
        service::disk_error("the data directory " + directory.string() + " is served, and nothing new is kept in it");
    if (Status kinds = require_kinds(directory); !kinds) return kinds.error();
    if (Status made = writable ? make_directories(directory) : Status(Done{}); !made) return made.error();
    const Expected<int> descriptor = lock(directory);
    if (!descriptor) return descriptor.error();
    DataDir opened(directory, *descriptor, writable);
    Status ready = opened.open_archive(quota, report);
    if (!ready && writable && ready.error().cause == Cause::kLimitExceeded) {
        DiskReserve(directory / kReserveName).give();
        ready = opened.open_archive(quota, report);
    }
    if (!ready) return ready.error();
    if (!writable) report(unwritable.message);
    if (is_open_to_others(directory))
        report("the data directory " + directory.string() +
               " can be read by other users of this machine; its meshes and sessions are theirs to see");
    return opened;
}

Expected<std::unique_ptr<SessionIndex>> DataDir::open_index(const Report& report) const {
    if (writable_) remove_unusable_shared(directory_ / kIndexName);
    if (Status finished = writable_ ? finish_replacement(directory_) : Status(Done{}); !finished) return finished.error();
    const Expected<bool> damaged_log = look_over(directory_, writable_, report);
    if (!damaged_log) return damaged_log.error();
    Expected<std::unique_ptr<SqliteSessionIndex>> index = SqliteSessionIndex::open(directory_ / kIndexName, writable_);
    if (!index && writable_ && index.error().cause == Cause::kCorrupt) index = begin_anew(directory_, index.error(), report);
    if (!index) return index.error();
    if (*damaged_log) {  // or it would be found again after the next crash
        if (Status emptied = (*index)->empty_log(); !emptied) return emptied.error();
    }
    return std::unique_ptr<SessionIndex>(*std::move(index));
}

Status DataDir::open_archive(std::uint64_t quota, const Report& report) {
    Expected<std::unique_ptr<SessionIndex>> index = open_index(report);
    if (!index) return index.error();
    Expected<std::unique_ptr<FileBlobStore>> blobs = FileBlobStore::open(directory_ / kBlobsName, quota, writable_);
    if (!blobs) return blobs.error();
    archive_ = std::make_unique<StoredSessions>(*std::move(blobs), *std::move(index), DiskReserve(directory_ / kReserveName),
                                                quota, report, [directory = directory_] { return count_damaged(directory); });
    return Done{};
}

DataDir::~DataDir() {
    if (lock_ >= 0) close(lock_);
}

DataDir::DataDir(DataDir&& other) noexcept
    : directory_(std::move(other.directory_)),
      lock_(std::exchange(other.lock_, -1)),
      writable_(other.writable_),
      archive_(std::move(other.archive_)) {}

}  // namespace vsplit::store

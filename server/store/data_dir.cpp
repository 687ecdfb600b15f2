#include "store/data_dir.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <string>
#include <system_error>
#include <utility>

#include "service/disk_error.h"
#include "store/file_blob_store.h"
#include "store/sqlite_session_index.h"

namespace vsplit::store {
namespace {

namespace fs = std::filesystem;

constexpr const char* kIndex = "sessions.db";
constexpr const char* kBlobs = "blobs";

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

/// Puts what cannot be read out of the way, as it is. Returns where.
Expected<fs::path> put_aside(const fs::path& directory) {
    std::error_code failed;
    fs::path aside;
    for (int number = 1; aside.empty() || fs::exists(aside, failed); ++number) {
        aside = directory / ("damaged-" + std::to_string(number));
    }
    fs::create_directory(aside, failed);
    for (const std::string& name :
         {std::string(kIndex), std::string(kIndex) + "-wal", std::string(kIndex) + "-shm", std::string(kBlobs)}) {
        if (!failed && fs::exists(directory / name)) fs::rename(directory / name, aside / name, failed);
    }
    if (failed) return service::disk_error("cannot put its damaged index aside in " + aside.string(), failed.value());
    return aside;
}

}  // namespace

Expected<DataDir> DataDir::open(const fs::path& directory, std::uint64_t quota, const Report& report) {
    const bool writable = !fs::exists(directory / kIndex) || access(directory.c_str(), W_OK) == 0;
    if (!writable)
        report(service::disk_error("the data directory " + directory.string() + " is served, and nothing new is kept in it")
                   .message);
    if (Status made = writable ? make_directories(directory) : Status(Done{}); !made) return made.error();
    const Expected<int> descriptor = lock(directory);
    if (!descriptor) return descriptor.error();
    DataDir opened(directory, *descriptor, writable);
    if (Status ready = opened.open_archive(quota, report); !ready) return ready.error();
    return opened;
}

Status DataDir::open_archive(std::uint64_t quota, const Report& report) {
    Expected<std::unique_ptr<SqliteSessionIndex>> index = SqliteSessionIndex::open(directory_ / kIndex, writable_);
    if (!index && writable_ && index.error().cause == Cause::kCorrupt) {
        const Expected<fs::path> aside = put_aside(directory_);
        if (!aside) return aside.error();
        report(index.error().message + "; put aside untouched in " + aside->string() + ", and begun anew without its sessions");
        index = SqliteSessionIndex::open(directory_ / kIndex);
    }
    if (!index) return index.error();
    Expected<std::unique_ptr<FileBlobStore>> blobs = FileBlobStore::open(directory_ / kBlobs, quota, writable_);
    if (!blobs) return blobs.error();
    archive_ = std::make_unique<StoredSessions>(*std::move(blobs), *std::move(index), DiskReserve(directory_ / "reserve"), quota,
                                                report);
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

#include "store/file_blob_store.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <iterator>
#include <string>
#include <system_error>
#include <utility>

#include "guard/digest.h"
#include "service/disk_error.h"
#include "service/limits.h"
#include "store/sync_directory.h"

namespace vsplit::store {
namespace {

namespace fs = std::filesystem;

constexpr const char* kAside = "aside";

/// Closes at the end of the scope.
class Descriptor {
public:
    Descriptor(const fs::path& path, int flags) : number_(::open(path.c_str(), flags | O_CLOEXEC, 0600)) {}
    ~Descriptor() {
        if (number_ >= 0) ::close(number_);
    }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    [[nodiscard]] int number() const { return number_; }
    [[nodiscard]] bool open() const { return number_ >= 0; }

private:
    int number_;
};

class LoadedBlob final : public Blob {
public:
    explicit LoadedBlob(std::size_t size) : bytes_(std::make_unique_for_overwrite<std::byte[]>(size)), size_(size) {}
    [[nodiscard]] Bytes bytes() const override { return {bytes_.get(), size_}; }
    [[nodiscard]] std::span<std::byte> room() { return {bytes_.get(), size_}; }

private:
    std::unique_ptr<std::byte[]> bytes_;
    std::size_t size_;
};

std::uint64_t size_of(std::span<const Bytes> parts) {
    std::uint64_t size = 0;
    for (const Bytes part : parts) size += part.size();
    return size;
}

bool write_all(int descriptor, Bytes bytes) {
    while (!bytes.empty()) {
        const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) return false;
        bytes = bytes.subspan(static_cast<std::size_t>(written));
    }
    return true;
}

// What was being written when a server ended: its names are numbers.
void remove_incoming(const fs::path& directory) {
    std::error_code ignored;
    std::error_code failed;
    for (fs::directory_iterator at(directory, failed), end; !failed && at != end; at.increment(failed)) {
        const std::string name = at->path().filename().string();
        if (name.find_first_not_of("0123456789") == std::string::npos) fs::remove(at->path(), ignored);
    }
}

bool is_key(const std::string& name) {
    return name.size() == 64 && name.find_first_not_of("0123456789abcdef") == std::string::npos;
}

/// False where the file ends before `room` is full; errno tells what else went wrong.
Expected<bool> read_all(int descriptor, std::span<std::byte> room) {
    while (!room.empty()) {
        const ssize_t count = ::read(descriptor, room.data(), room.size());
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) return service::disk_error("cannot read a stored mesh");
        if (count == 0) return false;
        room = room.subspan(static_cast<std::size_t>(count));
    }
    return true;
}

// Read, not mapped: a file that somebody cuts short while it is mapped ends the process by SIGBUS.
Expected<std::shared_ptr<const Blob>> read_file(const fs::path& place, std::uint64_t bytes) {
    const auto corrupt = [&place](const std::string& what) {
        return Error{Cause::kCorrupt, "the data directory: " + place.filename().string() + what, ""};
    };
    const Descriptor file(place, O_RDONLY | O_NONBLOCK);  // what is no file may be a pipe
    if (!file.open() && errno == ENOENT) return corrupt(" is missing");
    struct stat about {};
    if (!file.open() || fstat(file.number(), &about) != 0) return service::disk_error("cannot open a stored mesh");
    if (!S_ISREG(about.st_mode)) return corrupt(" is not a file");
    if (static_cast<std::uint64_t>(about.st_size) != bytes)
        return corrupt(" has " + std::to_string(about.st_size) + " bytes instead of " + std::to_string(bytes));
    const auto blob = std::make_shared<LoadedBlob>(static_cast<std::size_t>(about.st_size));
    const Expected<bool> whole = read_all(file.number(), blob->room());
    if (!whole) return whole.error();
    if (!*whole) return corrupt(" was cut short while it was read");
    return std::shared_ptr<const Blob>(blob);
}

}  // namespace

Expected<std::unique_ptr<FileBlobStore>> FileBlobStore::open(fs::path directory, std::uint64_t quota, bool writable) {
    std::unique_ptr<FileBlobStore> store(new FileBlobStore(std::move(directory), quota));
    std::error_code failed;
    if (writable) remove_incoming(store->incoming_);
    if (writable) fs::create_directories(store->incoming_, failed);
    if (failed) return service::disk_error("cannot make " + store->incoming_.string(), failed.value());
    const Expected<std::vector<BlobEntry>> all = store->list();
    if (!all) return all.error();
    for (const BlobEntry& blob : *all) store->bytes_ += blob.bytes;
    return store;
}

fs::path FileBlobStore::place_of(const std::string& key) const { return directory_ / key.substr(0, 2) / key; }

std::uint64_t FileBlobStore::bytes() const {
    const std::lock_guard lock(mutex_);
    return bytes_;
}

Status FileBlobStore::take_room(std::uint64_t bytes) {
    const std::lock_guard lock(mutex_);
    if (quota_ != 0 && (bytes > quota_ || bytes_ > quota_ - bytes)) {
        return Error{Cause::kLimitExceeded,
                     "keeping this takes " + std::to_string(bytes) + " bytes of disk; " + std::to_string(bytes_) +
                         " of the server's limit max_disk_bytes, " + std::to_string(quota_) + ", are in use; delete a session",
                     "", bytes <= quota_ ? service::kRetryAfter : 0};
    }
    bytes_ += bytes;
    return Done{};
}

void FileBlobStore::give_back(std::uint64_t bytes) {
    const std::lock_guard lock(mutex_);
    bytes_ -= std::min(bytes, bytes_);  // somebody else may have made a file larger
}

std::string FileBlobStore::key_of(std::span<const Bytes> parts) const { return guard::hex_digits(guard::digest_of(parts)); }

Expected<BlobEntry> FileBlobStore::put(std::span<const Bytes> parts) {
    BlobEntry blob{key_of(parts), size_of(parts)};
    std::error_code failed;
    const bool there = fs::exists(place_of(blob.key), failed);
    if (failed) return service::disk_error("cannot keep a mesh in the data directory", failed.value());
    if (there) {
        const Expected<std::shared_ptr<const Blob>> kept = get(blob);
        if (kept) return blob;
        if (kept.error().cause != Cause::kCorrupt) return kept.error();
    }
    if (Status room = take_room(blob.bytes); !room) return room.error();
    const Expected<bool> written = write(blob.key, parts, there ? InPlace::kDamaged : InPlace::kNothing);
    if (!written || !*written) give_back(blob.bytes);
    if (!written) return written.error();
    return blob;
}

/// A damaged blob in its place is put aside when the new one is on disk. False where another caller was quicker with the same
/// bytes.
Expected<bool> FileBlobStore::write(const std::string& key, std::span<const Bytes> parts, InPlace found) {
    const fs::path place = place_of(key);
    const fs::path incoming = incoming_ / std::to_string(++written_);
    const auto fail = [&incoming] {
        const int number = errno;
        unlink(incoming.c_str());
        return service::disk_error("cannot keep a mesh in the data directory", number);
    };
    {
        const Descriptor file(incoming, O_WRONLY | O_CREAT | O_TRUNC);
        if (!file.open()) return fail();
        for (const Bytes part : parts) {
            if (!write_all(file.number(), part)) return fail();
        }
        if (fsync(file.number()) != 0) return fail();
    }
    const fs::path directory = place.parent_path();
    if (mkdir(directory.c_str(), 0700) == 0) {
        if (!sync_directory(directory_)) return fail();
    } else if (errno != EEXIST) {
        return fail();
    }
    if (found == InPlace::kDamaged) {
        if (Status aside = put_aside(key); !aside) {
            unlink(incoming.c_str());
            return aside.error();
        }
    }
    const bool first = link(incoming.c_str(), place.c_str()) == 0;
    if (!first && errno != EEXIST) return fail();
    unlink(incoming.c_str());
    if (!sync_directory(directory)) return service::disk_error("cannot keep a mesh in the data directory");
    return first;
}

Expected<std::shared_ptr<const Blob>> FileBlobStore::get(const BlobEntry& entry) const {
    const std::string& key = entry.key;
    Expected<std::shared_ptr<const Blob>> blob = read_file(place_of(key), entry.bytes);
    if (!blob) return blob;
    const Bytes bytes = (*blob)->bytes();
    if (key_of({&bytes, 1}) == key) return blob;
    return Error{Cause::kCorrupt, "the data directory: " + key + " does not hold the bytes that were kept under this name", ""};
}

Status FileBlobStore::put_aside(const std::string& key) {
    const fs::path aside = directory_ / kAside;
    struct stat about {};
    std::error_code failed;
    fs::create_directory(aside, failed);
    if (failed || stat(place_of(key).c_str(), &about) != 0 ||
        rename(place_of(key).c_str(), (aside / (key + ".blob")).c_str()) != 0)
        return service::disk_error("cannot put a stored mesh aside");
    if (S_ISREG(about.st_mode)) give_back(static_cast<std::uint64_t>(about.st_size));
    return Done{};
}

Status FileBlobStore::remove(const std::string& key) {
    const fs::path place = place_of(key);
    struct stat about {};
    if (stat(place.c_str(), &about) != 0 && errno == ENOENT) return Done{};
    if (unlink(place.c_str()) != 0) return service::disk_error("cannot remove a stored mesh");
    give_back(static_cast<std::uint64_t>(about.st_size));
    return Done{};
}

std::uint64_t FileBlobStore::aside() const {
    std::error_code failed;
    const fs::directory_iterator files(directory_ / kAside, failed);
    return failed ? 0 : static_cast<std::uint64_t>(std::distance(begin(files), end(files)));
}

Expected<std::vector<BlobEntry>> FileBlobStore::list() const {
    std::vector<BlobEntry> blobs;
    std::error_code failed;
    const auto options = fs::directory_options::skip_permission_denied;
    for (fs::recursive_directory_iterator at(directory_, options, failed), end; !failed && at != end; at.increment(failed)) {
        const std::string name = at->path().filename().string();
        std::error_code unknown;
        if (is_key(name) && at->is_regular_file(unknown)) blobs.push_back({name, at->file_size(unknown)});
    }
    if (failed) return service::disk_error("cannot read " + directory_.string(), failed.value());
    std::sort(blobs.begin(), blobs.end(), [](const BlobEntry& a, const BlobEntry& b) { return a.key < b.key; });
    return blobs;
}

}  // namespace vsplit::store

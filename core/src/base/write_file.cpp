#include "base/write_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <cstdio>
#include <optional>
#include <string>

#include "base/descriptor.h"
#include "base/file_error.h"

namespace vsplit {
namespace {

namespace fs = std::filesystem;

bool write_all(int descriptor, std::string_view bytes) {
    while (!bytes.empty()) {
        const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) return false;
        bytes.remove_prefix(static_cast<std::size_t>(written));
    }
    return true;
}

fs::path directory_of(const fs::path& path) { return path.has_parent_path() ? path.parent_path() : fs::path("."); }

/// A name in the same directory that no other process or thread of this one takes.
fs::path temporary_beside(const fs::path& path) {
    static std::atomic<unsigned> next{0};
    return directory_of(path) / (".vsplit-" + std::to_string(::getpid()) + "-" + std::to_string(next++) + ".tmp");
}

/// The error, if any, of writing to what is there already.
std::optional<Error> write_in_place(const fs::path& path, std::string_view bytes) {
    const Descriptor file(::open(path.c_str(), O_WRONLY | O_CLOEXEC));
    if (!file.valid()) return file_error("open", path);
    if (!write_all(file.get(), bytes)) return file_error("write", path);
    return {};
}

/// `path` is what the error names.
std::optional<Error> write_new(const fs::path& temporary, const fs::path& path, std::string_view bytes) {
    constexpr mode_t kMode = 0666;  // the user's umask decides
    const Descriptor file(::open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, kMode));
    if (!file.valid()) return file_error("create", path);
    if (!write_all(file.get(), bytes) || ::fsync(file.get()) != 0) return file_error("write", path);
    return {};
}

/// The rename itself survives a power cut only when the directory is on the disk.
void sync_directory(const fs::path& directory) {
    const Descriptor handle(::open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    if (handle.valid()) ::fsync(handle.get());  // not all file systems offer it, and the content is whole either way
}

std::optional<Error> replace(const fs::path& path, std::string_view bytes) {
    const fs::path temporary = temporary_beside(path);
    std::optional<Error> error = write_new(temporary, path, bytes);
    if (!error && std::rename(temporary.c_str(), path.c_str()) != 0) error = file_error("write", path);
    if (error) {
        std::remove(temporary.c_str());
        return error;
    }
    sync_directory(directory_of(path));
    return {};
}

}  // namespace

Status write_file(const fs::path& path, std::string_view bytes) {
    std::error_code ignored;  // what does not exist yet is made
    const fs::path target = fs::exists(path, ignored) ? fs::canonical(path, ignored) : path;
    const fs::file_status status = fs::status(target, ignored);
    if (fs::is_directory(status)) return file_error("write", path, EISDIR);
    const bool special = fs::exists(status) && !fs::is_regular_file(status);
    std::optional<Error> error = special ? write_in_place(target, bytes) : replace(target, bytes);
    if (error) return *std::move(error);
    return Done{};
}

}  // namespace vsplit

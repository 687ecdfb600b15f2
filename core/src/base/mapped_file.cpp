#include "base/mapped_file.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>

#include <utility>

#include "base/descriptor.h"
#include "base/file_error.h"

namespace vsplit {
namespace {

/// A pipe or a device may never end.
constexpr std::size_t kMostUnmapped = std::size_t{4} << 30;

}  // namespace

Expected<MappedFile> MappedFile::open(const std::filesystem::path& path) {
    const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
    if (!file.valid()) return file_error("open", path);
    struct stat status {};
    if (::fstat(file.get(), &status) != 0) return file_error("open", path);
    if (S_ISDIR(status.st_mode)) return file_error("read", path, EISDIR);
    return S_ISREG(status.st_mode) ? map(file.get(), static_cast<std::size_t>(status.st_size), path) : read_all(file.get(), path);
}

Expected<MappedFile> MappedFile::map(int descriptor, std::size_t size, const std::filesystem::path& path) {
    MappedFile file;
    if (size == 0) return file;  // the system maps no empty file
    void* const start = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, descriptor, 0);
    if (start == MAP_FAILED) return file_error("map", path);
    ::madvise(start, size, MADV_SEQUENTIAL);
    file.bytes_ = {static_cast<const std::byte*>(start), size};
    return file;
}

Expected<MappedFile> MappedFile::read_all(int descriptor, const std::filesystem::path& path) {
    constexpr std::size_t kPart = std::size_t{1} << 16;
    MappedFile file;
    std::size_t size = 0;
    for (;;) {
        if (size > kMostUnmapped) {
            return Error{Cause::kLimitExceeded,
                         "more than 4 GiB came from '" + path.string() + "', which is no regular file; save it to one first", ""};
        }
        file.copy_.resize(size + kPart);
        const ssize_t got = ::read(descriptor, file.copy_.data() + size, kPart);
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) return file_error("read", path);
        if (got == 0) break;
        size += static_cast<std::size_t>(got);
    }
    file.copy_.resize(size);
    file.bytes_ = file.copy_;
    return file;
}

MappedFile::MappedFile(MappedFile&& other) noexcept : bytes_(std::exchange(other.bytes_, {})), copy_(std::move(other.copy_)) {}

MappedFile& MappedFile::operator=(MappedFile&& other) noexcept {
    std::swap(bytes_, other.bytes_);
    std::swap(copy_, other.copy_);
    return *this;
}

MappedFile::~MappedFile() {
    if (copy_.empty() && !bytes_.empty()) ::munmap(const_cast<std::byte*>(bytes_.data()), bytes_.size());
}

}  // namespace vsplit

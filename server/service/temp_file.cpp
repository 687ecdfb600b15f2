#include "service/temp_file.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <system_error>
#include <utility>

#include "service/disk_error.h"

namespace vsplit::service {
namespace {

std::filesystem::path usual_directory() {
    std::error_code failed;
    const std::filesystem::path directory = std::filesystem::temp_directory_path(failed);
    return failed ? "/tmp" : directory;
}

// For file systems that know no O_TMPFILE.
int create_and_unlink(const std::filesystem::path& directory) {
    std::string name = (directory / "vsplit-XXXXXX").string();
    const int descriptor = mkostemp(name.data(), O_CLOEXEC);
    if (descriptor >= 0) unlink(name.c_str());
    return descriptor;
}

}  // namespace

FileMapping::~FileMapping() {
    if (address_ != nullptr) munmap(address_, size_);
}

FileMapping::FileMapping(FileMapping&& other) noexcept
    : address_(std::exchange(other.address_, nullptr)), size_(std::exchange(other.size_, 0)) {}

FileMapping& FileMapping::operator=(FileMapping&& other) noexcept {
    std::swap(address_, other.address_);
    std::swap(size_, other.size_);
    return *this;
}

std::filesystem::path TempFile::directory_of(const std::filesystem::path& wanted) {
    return wanted.empty() ? usual_directory() : wanted;
}

Expected<TempFile> TempFile::create(const std::filesystem::path& wanted) {
    const std::filesystem::path directory = directory_of(wanted);
    int descriptor = open(directory.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0600);
    if (descriptor < 0) descriptor = create_and_unlink(directory);
    if (descriptor < 0) return disk_error("cannot make a temporary file");
    return TempFile(descriptor);
}

TempFile::~TempFile() {
    if (descriptor_ >= 0) close(descriptor_);
}

TempFile::TempFile(TempFile&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)), size_(other.size_) {}

TempFile& TempFile::operator=(TempFile&& other) noexcept {
    std::swap(descriptor_, other.descriptor_);
    std::swap(size_, other.size_);
    return *this;
}

Status TempFile::append(std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
        const ssize_t written = write(descriptor_, bytes.data(), bytes.size());
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) return disk_error("cannot write to a temporary file");
        bytes = bytes.subspan(static_cast<std::size_t>(written));
        size_ += static_cast<std::uint64_t>(written);
    }
    return Done{};
}

Expected<FileMapping> TempFile::map() const {
    if (size_ == 0) return FileMapping();
    void* const address = mmap(nullptr, size_, PROT_READ, MAP_PRIVATE, descriptor_, 0);
    if (address == MAP_FAILED) return disk_error("cannot map a temporary file");
    return FileMapping(address, size_);
}

}  // namespace vsplit::service

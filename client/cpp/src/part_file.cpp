#include "part_file.h"

#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <string>
#include <system_error>
#include <utility>

namespace vsplit::client {
namespace {

Error refused(const char* what, const std::filesystem::path& path) {
    const int reason = errno;
    return {reason == ENOENT ? Cause::kNotFound : Cause::kFileAccess,
            std::string("cannot ") + what + " '" + path.string() + "': " + std::generic_category().message(reason), ""};
}

std::filesystem::path name_beside(const std::filesystem::path& path) {
    static std::atomic<unsigned> next{0};
    return path.parent_path() / (".vsplit-" + std::to_string(::getpid()) + "-" + std::to_string(next++) + ".part");
}

}  // namespace

PartFile::PartFile(std::filesystem::path path, std::filesystem::path part, std::FILE* file)
    : path_(std::move(path)), part_(std::move(part)), file_(file) {}

PartFile::PartFile(PartFile&& other) noexcept
    : path_(std::move(other.path_)), part_(std::exchange(other.part_, {})), file_(std::move(other.file_)), size_(other.size_) {}

PartFile::~PartFile() {
    file_.reset();
    if (!part_.empty()) std::remove(part_.c_str());
}

Expected<PartFile> PartFile::create(const std::filesystem::path& path) {
    const std::filesystem::path part = name_beside(path);
    std::FILE* const file = std::fopen(part.c_str(), "wbx");
    if (file == nullptr) return refused("create a file beside", path);
    return PartFile(path, part, file);
}

Status PartFile::write(std::string_view bytes) {
    if (std::fwrite(bytes.data(), 1, bytes.size(), file_.get()) != bytes.size()) return refused("write", path_);
    size_ += bytes.size();
    return Done{};
}

Status PartFile::commit() {
    const bool flushed = std::fflush(file_.get()) == 0 && ::fsync(::fileno(file_.get())) == 0;
    if (!flushed) return refused("write", path_);
    if (std::rename(part_.c_str(), path_.c_str()) != 0) return refused("write", path_);
    part_.clear();
    return Done{};
}

}  // namespace vsplit::client

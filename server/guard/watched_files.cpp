#include "guard/watched_files.h"

#include <sys/stat.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <memory>
#include <system_error>
#include <utility>

namespace vsplit::guard {

WatchedFiles::WatchedFiles(std::vector<std::string> names, std::chrono::milliseconds pause)
    : names_(std::move(names)), pause_(pause), seen_(look()) {}

bool WatchedFiles::changed() {
    if (Clock::now() - looked_ < pause_) return false;
    looked_ = Clock::now();
    Marks now = look();
    if (now == seen_ && failure_.empty()) return false;
    seen_ = std::move(now);
    return true;
}

bool WatchedFiles::note(const Status& read) {
    const std::string before = std::exchange(failure_, read ? "" : read.error().message);
    return read.has_value() || failure_ != before;
}

WatchedFiles::Marks WatchedFiles::look() const {
    Marks marks;
    for (const std::string& name : names_) {
        struct stat is {};
        if (name.empty() || stat(name.c_str(), &is) != 0) is = {};
        marks.insert(marks.end(), {is.st_mtim.tv_sec, is.st_mtim.tv_nsec, is.st_ctim.tv_sec, is.st_ctim.tv_nsec, is.st_size,
                                   static_cast<std::int64_t>(is.st_ino)});
    }
    return marks;
}

Expected<std::string> read_small_file(const std::string& name, std::size_t most) {
    const auto failed = [&name](const std::string& why) {
        return Error{Cause::kFileAccess, "cannot read " + name + ": " + why, ""};
    };
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(name.c_str(), "rbe"), &std::fclose);
    if (!file) return failed(std::generic_category().message(errno));
    std::string text;
    std::array<char, 16384> part{};
    while (text.size() <= most) {
        const std::size_t got = std::fread(part.data(), 1, part.size(), file.get());
        text.append(part.data(), got);
        if (got < part.size()) break;
    }
    if (std::ferror(file.get()) != 0) return failed(std::generic_category().message(errno));
    if (text.size() > most) return Error{Cause::kLimitExceeded, name + " is longer than " + std::to_string(most) + " bytes", ""};
    return text;
}

}  // namespace vsplit::guard

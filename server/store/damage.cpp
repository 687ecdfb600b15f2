#include "store/damage.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <string>
#include <string_view>
#include <system_error>

#include "service/disk_error.h"

namespace vsplit::store {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kAside = "damaged-";

/// Whether both names are there and mean one file, or neither is.
bool same_file(const fs::path& a, const fs::path& b) {
    std::error_code unknown;
    const bool there = fs::exists(a, unknown);
    return there == fs::exists(b, unknown) && (!there || fs::equivalent(a, b, unknown));
}

/// Whether the index was kept in `place` before the process ended.
bool holds_index(const fs::path& place, const fs::path& directory) {
    std::error_code unknown;
    return fs::exists(place / kIndexName, unknown) && same_file(directory / kIndexName, place / kIndexName) &&
           same_file(directory / (kIndexName + std::string("-wal")), place / (kIndexName + std::string("-wal")));
}

/// Makes it.
Expected<fs::path> new_place(const fs::path& directory) {
    for (int number = 1;; ++number) {
        const fs::path place = directory / (std::string(kAside) + std::to_string(number));
        std::error_code failed;
        if (holds_index(place, directory)) return place;
        if (fs::create_directory(place, failed)) return place;
        if (failed && failed != std::errc::file_exists)
            return service::disk_error("cannot make " + place.string(), failed.value());
    }
}

/// What is there of `name`, by what moves or copies it.
template <class Take>
void take(const fs::path& from, const fs::path& to, std::error_code& failed, const Take& how) {
    std::error_code unknown;
    if (!failed && fs::exists(from, unknown)) how(from, to, failed);
}

void copy_synchronised(const fs::path& from, const fs::path& to, std::error_code& failed) {
    fs::copy_file(from, to, failed);
    if (failed) return;
    const int copy = ::open(to.c_str(), O_RDONLY | O_CLOEXEC);
    if (copy < 0 || fsync(copy) != 0) failed.assign(errno, std::generic_category());
    if (copy >= 0) close(copy);
}

}  // namespace

Expected<fs::path> keep_damaged(const fs::path& directory, Original original) {
    Expected<fs::path> place = new_place(directory);
    if (!place) return place;
    std::error_code failed;
    const bool is_new = !holds_index(*place, directory);
    if (is_new)
        take(directory / kBlobsName, *place / kBlobsName, failed,
             [](const fs::path& from, const fs::path& to, std::error_code& e) {
                 fs::copy(from, to, fs::copy_options::recursive | fs::copy_options::create_hard_links, e);
             });
    for (const std::string_view suffix : {"-wal", "-shm", ""}) {
        const std::string name = kIndexName + std::string(suffix);
        if (original == Original::kIsUsed) {
            take(directory / name, *place / name, failed, copy_synchronised);
        } else if (original == Original::kIsReplaced) {
            if (is_new)
                take(directory / name, *place / name, failed,
                     [](const fs::path& from, const fs::path& to, std::error_code& e) { fs::create_hard_link(from, to, e); });
        } else {
            take(directory / name, *place / name, failed,
                 [](const fs::path& from, const fs::path& to, std::error_code& e) { fs::rename(from, to, e); });
        }
    }
    if (failed) return service::disk_error("cannot put its damaged index aside in " + place->string(), failed.value());
    return place;
}

std::uint32_t count_damaged(const fs::path& directory) {
    std::uint32_t count = 0;
    std::error_code failed;
    for (fs::directory_iterator at(directory, failed), end; !failed && at != end; at.increment(failed)) {
        if (at->path().filename().string().starts_with(kAside)) ++count;
    }
    return count;
}

}  // namespace vsplit::store

#pragma once

#include <fcntl.h>
#include <unistd.h>

#include <filesystem>

namespace vsplit::store {

/// Names made, changed and removed in a directory are for good when it has been synchronised. False where it cannot be; errno
/// tells.
[[nodiscard]] inline bool sync_directory(const std::filesystem::path& directory) {
    const int opened = ::open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (opened < 0) return false;
    const bool done = fsync(opened) == 0;
    ::close(opened);
    return done;
}

}  // namespace vsplit::store

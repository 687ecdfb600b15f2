#include "service/machine_memory.h"

#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <string>

namespace vsplit::service {
namespace {

namespace fs = std::filesystem;

/// What the file says; "max", and a file that is not there, limit nothing.
std::uint64_t number_in(const fs::path& file) {
    std::ifstream text(file);
    std::uint64_t bytes = 0;
    return text >> bytes ? bytes : std::numeric_limits<std::uint64_t>::max();
}

/// The least of a group and all around it. A container may see its group as the root and yet be told of its name on the host.
std::uint64_t least_on_the_way(const fs::path& root, const fs::path& group, const char* file) {
    std::uint64_t least = number_in(root / file);
    fs::path at = root;
    for (const fs::path& part : group.relative_path()) {
        at /= part;
        least = std::min(least, number_in(at / file));
    }
    return least;
}

}  // namespace

std::uint64_t control_group_memory(const fs::path& groups, const fs::path& membership) {
    std::uint64_t least = std::numeric_limits<std::uint64_t>::max();
    std::ifstream lines(membership);
    // NUMBER:CONTROLLERS:GROUP; version 2 has no controllers there.
    for (std::string line; std::getline(lines, line);) {
        const std::size_t first = line.find(':');
        const std::size_t second = line.find(':', first + 1);
        if (second == std::string::npos) continue;
        const std::string controllers = ',' + line.substr(first + 1, second - first - 1) + ',';
        const fs::path group = line.substr(second + 1);
        if (controllers == ",,") least = std::min(least, least_on_the_way(groups, group, "memory.max"));
        if (controllers.find(",memory,") != std::string::npos)
            least = std::min(least, least_on_the_way(groups / "memory", group, "memory.limit_in_bytes"));
    }
    return least;
}

std::uint64_t usual_memory_limit() {
    const std::uint64_t bytes =
        static_cast<std::uint64_t>(sysconf(_SC_PHYS_PAGES)) * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
    return std::min(bytes, control_group_memory("/sys/fs/cgroup", "/proc/self/cgroup")) / 4 * 3;
}

}  // namespace vsplit::service

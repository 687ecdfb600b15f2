#include "ops/process_use.h"

#include <sys/resource.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <system_error>

namespace vsplit::ops {
namespace {

std::size_t resident_bytes() {
    std::ifstream file("/proc/self/statm");
    std::size_t total = 0;
    std::size_t resident = 0;
    if (!(file >> total >> resident)) return 0;
    return resident * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

std::size_t descriptors() {
    std::error_code failed;
    const std::filesystem::directory_iterator listed("/proc/self/fd", failed);
    return failed ? 0 : static_cast<std::size_t>(std::distance(begin(listed), end(listed)));
}

}  // namespace

ProcessUse process_use() {
    rlimit limit{};
    getrlimit(RLIMIT_NOFILE, &limit);
    return {resident_bytes(), descriptors(), limit.rlim_cur};
}

}  // namespace vsplit::ops

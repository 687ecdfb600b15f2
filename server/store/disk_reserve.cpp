#include "store/disk_reserve.h"

#include <fcntl.h>
#include <unistd.h>

#include <system_error>

namespace vsplit::store {

void DiskReserve::take() const {
    const int descriptor = ::open(file_.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0600);
    if (descriptor < 0) return;
    const bool taken = posix_fallocate(descriptor, 0, kBytes) == 0;
    ::close(descriptor);
    if (!taken) give();
}

void DiskReserve::give() const {
    std::error_code ignored;
    std::filesystem::remove(file_, ignored);
}

}  // namespace vsplit::store

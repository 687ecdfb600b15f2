#include "service/disk_error.h"

#include <unistd.h>

#include <cerrno>
#include <string>
#include <system_error>

#include "service/limits.h"

namespace vsplit::service {

Error disk_error(std::string_view what, int number) {
    const bool full = number == ENOSPC || number == EDQUOT || number == EFBIG;
    return {full ? Cause::kLimitExceeded : Cause::kUnavailable,
            std::string(what) + ": " + std::generic_category().message(number) +
                (number == EACCES ? " (the server runs as user " + std::to_string(geteuid()) + ')' : ""),
            "", kRetryAfter};
}

}  // namespace vsplit::service

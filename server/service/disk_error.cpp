#include "service/disk_error.h"

#include <system_error>

#include "service/limits.h"

namespace vsplit::service {

Error disk_error(std::string_view what, int number) {
    const bool full = number == ENOSPC || number == EDQUOT || number == EFBIG;
    return {full ? Cause::kLimitExceeded : Cause::kUnavailable,
            std::string(what) + ": " + std::generic_category().message(number), "", kRetryAfter};
}

}  // namespace vsplit::service

#include "store/disk_error.h"

#include <system_error>

#include "service/limits.h"

namespace vsplit::store {

Error disk_error(std::string_view what, int number) {
    const bool full = number == ENOSPC || number == EDQUOT || number == EFBIG;
    return {full ? Cause::kLimitExceeded : Cause::kUnavailable,
            "the data directory: " + std::string(what) + ": " + std::generic_category().message(number), "", service::kRetryAfter};
}

}  // namespace vsplit::store

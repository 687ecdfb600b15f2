#pragma once

#include <string>

#include "service/limits.h"
#include "vsplit/base/expected.h"

namespace vsplit::service {

/// What ends work that went on for longer than Limits::job_seconds. `what` is its subject, as "the method".
[[nodiscard]] inline Error took_too_long(const std::string& what, const Limits& limits) {
    return {Cause::kLimitExceeded,
            what + " ran for " + std::to_string(limits.job_seconds) + " s, the server's limit max_job_seconds; ask for less", ""};
}

}  // namespace vsplit::service

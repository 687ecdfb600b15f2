#pragma once

#include <stop_token>

#include "vsplit/client/call_options.h"

namespace vsplit::client {

/// The tries of something that may fail because a server is away for a moment, and the waits between them.
class Backoff {
public:
    Backoff(const RetryOptions& options, std::stop_token stop);

    /// Something came of the last try: it does not count.
    void reset();

    /// After a try that failed: waits, and says whether there is to be another. False at once where no try is left or a stop is
    /// requested.
    [[nodiscard]] bool again();

private:
    RetryOptions options_;
    std::stop_token stop_;
    int failed_ = 0;
    std::chrono::milliseconds wait_;
};

}  // namespace vsplit::client

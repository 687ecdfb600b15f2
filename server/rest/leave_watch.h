#pragma once

#include <functional>
#include <memory>

#include "rest/asio.h"
#include "rest/signal.h"
#include "rest/stream.h"

namespace vsplit::rest {

/// Notices that a client leaves while it waits for an answer, when nobody reads from it. What it sends meanwhile, its next
/// requests, goes into the buffer up to a limit; one that sends more is no longer watched. All calls from the stream's strand.
class LeaveWatch {
public:
    LeaveWatch(Stream& stream, beast::flat_buffer& buffer, std::size_t most_ahead);

    /// Watches from now on. `on_leave` is called at most once. \pre nothing is read from the stream until `stop` is through.
    void start(std::function<void()> on_leave);

    /// Ends it. \pre nothing is written just now: that would be cancelled too.
    Awaitable<void> stop();

private:
    struct State;

    static Awaitable<std::size_t> read_secure(std::shared_ptr<State> state, ErrorCode* failed);
    static Awaitable<void> watch(std::shared_ptr<State> state);

    Stream& stream_;
    beast::flat_buffer& buffer_;
    const std::size_t most_ahead_;
    std::shared_ptr<State> state_;
};

}  // namespace vsplit::rest

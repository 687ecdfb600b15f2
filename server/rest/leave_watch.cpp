#include "rest/leave_watch.h"

#include <utility>

namespace vsplit::rest {
namespace {

constexpr std::size_t kPart = 4096;

}  // namespace

struct LeaveWatch::State {
    Stream& stream;
    beast::flat_buffer& buffer;
    std::size_t most_ahead;
    std::function<void()> on_leave;
    std::shared_ptr<Signal> ended;
    bool stopped = false;
};

LeaveWatch::LeaveWatch(Stream& stream, beast::flat_buffer& buffer, std::size_t most_ahead)
    : stream_(stream), buffer_(buffer), most_ahead_(most_ahead) {}

void LeaveWatch::start(std::function<void()> on_leave) {
    if (state_ != nullptr) {
        state_->on_leave = std::move(on_leave);
        return;
    }
    state_ = std::make_shared<State>(
        State{stream_, buffer_, most_ahead_, std::move(on_leave), std::make_shared<Signal>(stream_.get_executor()), false});
    net::co_spawn(stream_.get_executor(), watch(state_),
                  [state = state_](const std::exception_ptr& /*bad_alloc*/) { state->ended->set(); });
}

Awaitable<void> LeaveWatch::stop() {
    const std::shared_ptr<State> state = std::exchange(state_, nullptr);
    if (state == nullptr) co_return;
    state->stopped = true;
    ErrorCode ignored;
    stream_.socket().cancel(ignored);
    co_await state->ended->wait();
}

// What TLS has read already does not show at the socket, so that a read waits here; `stop` cancels it, and nothing is lost by
// that.
Awaitable<std::size_t> LeaveWatch::read_secure(std::shared_ptr<State> state, ErrorCode* failed) {
    state->stream.expires_never();
    const auto room = state->buffer.prepare(kPart);
    const std::size_t got = co_await state->stream.async_read_some(room, into(*failed));
    co_return got;
}

Awaitable<void> LeaveWatch::watch(std::shared_ptr<State> state) {
    auto& socket = state->stream.socket();
    while (!state->stopped && state->buffer.size() + kPart <= state->most_ahead) {
        ErrorCode failed;
        std::size_t got = 0;
        if (state->stream.secure()) {
            got = co_await read_secure(state, &failed);
        } else {
            co_await socket.async_wait(net::socket_base::wait_read, into(failed));
            if (state->stopped) co_return;
            got = failed ? 0 : socket.read_some(state->buffer.prepare(kPart), failed);
        }
        state->buffer.commit(got);
        if (state->stopped) co_return;
        if (failed == net::error::would_block || failed == net::error::interrupted) continue;
        if (failed) {
            if (state->on_leave) state->on_leave();
            co_return;
        }
    }
}

}  // namespace vsplit::rest

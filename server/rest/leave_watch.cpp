#include "rest/leave_watch.h"

#include <utility>

namespace vsplit::rest {

struct LeaveWatch::State {
    beast::tcp_stream& stream;
    beast::flat_buffer& buffer;
    std::size_t most_ahead;
    std::function<void()> on_leave;
    std::shared_ptr<Signal> ended;
    bool stopped = false;
};

LeaveWatch::LeaveWatch(beast::tcp_stream& stream, beast::flat_buffer& buffer, std::size_t most_ahead)
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

Awaitable<void> LeaveWatch::watch(std::shared_ptr<State> state) {
    constexpr std::size_t kPart = 4096;
    auto& socket = state->stream.socket();
    while (!state->stopped && state->buffer.size() + kPart <= state->most_ahead) {
        ErrorCode failed;
        co_await socket.async_wait(net::socket_base::wait_read, into(failed));
        if (state->stopped) co_return;
        const std::size_t got = failed ? 0 : socket.read_some(state->buffer.prepare(kPart), failed);
        state->buffer.commit(got);
        if (failed == net::error::would_block || failed == net::error::interrupted) continue;
        if (failed) {
            if (state->on_leave) state->on_leave();
            co_return;
        }
    }
}

}  // namespace vsplit::rest

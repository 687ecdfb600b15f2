#pragma once

#include <chrono>
#include <memory>

#include "rest/asio.h"
#include "rest/stream.h"

namespace vsplit::rest {

/// Ends what is read from a stream when its time is up, and leaves the stream open for an answer: Beast's own deadline would
/// close it. For one strand; lives as long as the read.
class ReadAlarm {
public:
    ReadAlarm(Stream& stream, std::chrono::steady_clock::time_point when)
        : state_(std::make_shared<State>(State{net::steady_timer(stream.get_executor(), when)})) {
        stream.expires_never();
        state_->timer.async_wait([state = state_, &stream](const ErrorCode& /*of a timer*/) {
            if (state->over) return;
            state->rang = true;
            ErrorCode ignored;
            stream.socket().cancel(ignored);
        });
    }
    ReadAlarm(const ReadAlarm&) = delete;
    ReadAlarm& operator=(const ReadAlarm&) = delete;
    ~ReadAlarm() {
        state_->over = true;
        state_->timer.cancel();
    }

    [[nodiscard]] bool rang() const { return state_->rang; }

private:
    // Outlives the alarm where the timer has gone off but its handler has not run.
    struct State {
        net::steady_timer timer;
        bool over = false;
        bool rang = false;
    };

    const std::shared_ptr<State> state_;
};

}  // namespace vsplit::rest

#include "ops/line_writer.h"

#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <climits>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <string_view>
#include <utility>

namespace vsplit::ops {
namespace {

constexpr std::chrono::milliseconds kLastMoment{500};

// What cannot be written, to a pipe that is closed for example, is dropped. A pipe that poll calls writable takes so much at
// once.
void write_all(int descriptor, std::string_view text) {
    while (!text.empty()) {
        pollfd ready{descriptor, POLLOUT, 0};
        if (poll(&ready, 1, -1) < 0 && errno != EINTR) return;
        const ssize_t wrote = write(descriptor, text.data(), std::min<std::size_t>(text.size(), PIPE_BUF));
        if (wrote < 0 && errno != EINTR && errno != EAGAIN) return;
        if (wrote > 0) text.remove_prefix(static_cast<std::size_t>(wrote));
    }
}

}  // namespace

struct LineWriter::State {
    State(int to, LostLine tell, std::size_t limit) : descriptor(to), lost_line(std::move(tell)), most(limit) {}

    void put(std::string line) {
        const std::lock_guard lock(mutex);
        bytes += line.size();
        lines.push_back(std::move(line));
        for (; bytes > most && lines.size() > 1; ++lost) {
            bytes -= lines.front().size();
            lines.pop_front();
        }
        changed.notify_one();
    }

    void work() {
        std::unique_lock lock(mutex);
        while (true) {
            changed.wait(lock, [this] { return stopped || !lines.empty(); });
            if (lines.empty()) return;
            const std::string text = next();
            writing = true;
            lock.unlock();
            write_all(descriptor, text);
            lock.lock();
            writing = false;
            if (lines.empty()) done.notify_all();
        }
    }

    std::string next() {
        std::string text = lost == 0 ? std::string() : lost_line(std::exchange(lost, 0));
        text += lines.front();
        bytes -= lines.front().size();
        lines.pop_front();
        return text;
    }

    const int descriptor;
    const LostLine lost_line;
    const std::size_t most;
    std::mutex mutex;
    std::condition_variable changed;
    std::condition_variable done;
    std::deque<std::string> lines;
    std::size_t bytes = 0;
    std::uint64_t lost = 0;
    bool writing = false;
    bool stopped = false;
};

LineWriter::LineWriter(int descriptor, LostLine lost_line, std::size_t most)
    : state_(std::make_shared<State>(descriptor, std::move(lost_line), most)), thread_([state = state_] { state->work(); }) {}

LineWriter::~LineWriter() {
    const bool written = flush(kLastMoment);
    {
        const std::lock_guard lock(state_->mutex);
        state_->stopped = true;
        state_->changed.notify_one();
    }
    if (written) {
        thread_.join();
    } else {
        thread_.detach();
    }
}

void LineWriter::put(std::string line) { state_->put(std::move(line)); }

bool LineWriter::flush(std::chrono::milliseconds longest) {
    std::unique_lock lock(state_->mutex);
    return state_->done.wait_for(lock, longest, [this] { return state_->lines.empty() && !state_->writing; });
}

}  // namespace vsplit::ops

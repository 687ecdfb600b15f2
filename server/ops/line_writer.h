#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <thread>

namespace vsplit::ops {

/// Writes lines to a descriptor by a thread of its own, so that nobody waits for who reads them: where they pile up, the oldest
/// are dropped, and a line says how many. Thread-safe.
class LineWriter {
public:
    using LostLine = std::function<std::string(std::uint64_t lines)>;

    /// \param descriptor stays open. \param lost_line what tells of lines that were dropped. \param most bytes that wait
    LineWriter(int descriptor, LostLine lost_line, std::size_t most = std::size_t{4} << 20);

    /// Gives what is left a moment to be written.
    ~LineWriter();
    LineWriter(const LineWriter&) = delete;
    LineWriter& operator=(const LineWriter&) = delete;

    /// \param line with its end. Never waits for the descriptor.
    void put(std::string line);

    /// Waits until all is written, at most so long. Whether it is.
    bool flush(std::chrono::milliseconds longest);

private:
    struct State;

    std::shared_ptr<State> state_;  // the thread's too, which a write that never ends may keep
    std::thread thread_;
};

}  // namespace vsplit::ops

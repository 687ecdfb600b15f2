#pragma once

#include <sys/types.h>

#include <chrono>
#include <optional>
#include <string>
#include <vector>

namespace vsplit::test {

/// vsplitd as a process of its own; killed at the end of the scope if need be.
class ServerProcess {
public:
    /// Starts it; stderr goes to a file.
    explicit ServerProcess(const std::vector<std::string>& arguments);
    ~ServerProcess();
    ServerProcess(const ServerProcess&) = delete;
    ServerProcess& operator=(const ServerProcess&) = delete;

    /// The next line on its stdout; empty when it has closed that.
    [[nodiscard]] std::optional<std::string> read_line();

    void send(int signal) const;

    /// Exit status, once it has ended by itself; empty when it has not within the time, or was ended by a signal.
    [[nodiscard]] std::optional<int> wait(std::chrono::milliseconds within = std::chrono::seconds(20));

    /// What it wrote to stderr so far.
    [[nodiscard]] std::string errors() const;

    /// Memory that is its own and not a file's, in bytes.
    [[nodiscard]] std::size_t memory() const;

private:
    pid_t pid_ = -1;
    int output_ = -1;
    int errors_ = -1;
};

}  // namespace vsplit::test

#pragma once

#include <sys/types.h>

#include <chrono>
#include <string>
#include <vector>

#include "tests/temp_directory.h"

namespace vsplit::test {

/// What a command did.
struct CommandResult {
    int exit_status = -1;  ///< 128 + the signal that ended it, as a shell says
    std::string out;
    std::string err;
};

/// A running command, its output caught in files. Killed when it outlives `limit` or this object.
class Command {
public:
    explicit Command(const std::vector<std::string>& words, int stderr_descriptor = -1);
    ~Command();
    Command(const Command&) = delete;
    Command& operator=(const Command&) = delete;

    [[nodiscard]] pid_t pid() const { return pid_; }

    /// Whether it has said `text` on its standard output (or error) within `limit`.
    [[nodiscard]] bool says(const std::string& text, std::chrono::seconds limit) const;

    /// Whether it blocks `signal` within `limit`, which is how it prepares to be interrupted.
    [[nodiscard]] bool blocks(int signal, std::chrono::seconds limit) const;

    [[nodiscard]] CommandResult wait(std::chrono::seconds limit = std::chrono::seconds(120));

    [[nodiscard]] std::string out() const;
    [[nodiscard]] std::string err() const;

private:
    TempDirectory files_;
    pid_t pid_ = -1;
};

/// Runs a command to its end.
[[nodiscard]] CommandResult run_command(const std::vector<std::string>& words);

/// A file's bytes.
[[nodiscard]] std::string file_content(const std::filesystem::path& path);

}  // namespace vsplit::test

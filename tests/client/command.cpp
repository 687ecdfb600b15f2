#include "tests/client/command.h"

#include <fcntl.h>
#include <signal.h>  // NOLINT(modernize-deprecated-headers): kill is POSIX
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <functional>
#include <iterator>
#include <sstream>
#include <thread>

namespace vsplit::test {
namespace {

/// Asks every few milliseconds until it is so, or `limit` has passed.
bool comes_true(const std::function<bool()>& so, std::chrono::seconds limit) {
    const auto deadline = std::chrono::steady_clock::now() + limit;
    while (!so()) {
        if (std::chrono::steady_clock::now() >= deadline) return false;
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return true;
}

/// The line of /proc/PID/status that begins with `key`, without it.
std::string process_status(pid_t pid, const std::string& key) {
    std::ifstream status("/proc/" + std::to_string(pid) + "/status");
    for (std::string line; std::getline(status, line);) {
        if (line.starts_with(key)) return line.substr(key.size());
    }
    return {};
}

}  // namespace

Command::Command(const std::vector<std::string>& words, int stderr_descriptor) {
    std::vector<char*> argv;
    argv.reserve(words.size() + 1);
    for (const std::string& word : words)
        argv.push_back(const_cast<char*>(word.c_str()));  // exec takes them so and leaves them alone
    argv.push_back(nullptr);
    constexpr int kWrite = O_WRONLY | O_CREAT | O_TRUNC;
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, (files_.path() / "out").c_str(), kWrite, 0600);
    if (stderr_descriptor >= 0) {
        posix_spawn_file_actions_adddup2(&actions, stderr_descriptor, STDERR_FILENO);
    } else {
        posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, (files_.path() / "err").c_str(), kWrite, 0600);
    }
    if (posix_spawn(&pid_, argv[0], &actions, nullptr, argv.data(), environ) != 0) pid_ = -1;
    posix_spawn_file_actions_destroy(&actions);
}

Command::~Command() {
    if (pid_ < 0) return;
    ::kill(pid_, SIGKILL);
    ::waitpid(pid_, nullptr, 0);
}

std::string Command::out() const { return file_content(files_.path() / "out"); }
std::string Command::err() const { return file_content(files_.path() / "err"); }

bool Command::says(const std::string& text, std::chrono::seconds limit) const {
    return comes_true([&] { return (out() + err()).find(text) != std::string::npos; }, limit);
}

bool Command::blocks(int signal, std::chrono::seconds limit) const {
    const auto blocked = [&] {
        const std::string mask = process_status(pid_, "SigBlk:");
        return !mask.empty() && ((std::stoull(mask, nullptr, 16) >> (signal - 1)) & 1U) != 0;
    };
    return comes_true(blocked, limit);
}

CommandResult Command::wait(std::chrono::seconds limit) {
    CommandResult result;
    int status = 0;
    const auto ended = [&] { return pid_ < 0 || ::waitpid(pid_, &status, WNOHANG) == pid_; };
    if (!comes_true(ended, limit)) {
        ::kill(pid_, SIGKILL);
        ::waitpid(pid_, &status, 0);
    }
    if (pid_ >= 0) result.exit_status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    pid_ = -1;
    result.out = out();
    result.err = err();
    return result;
}

CommandResult run_command(const std::vector<std::string>& words) { return Command(words).wait(); }

std::string file_content(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace vsplit::test

#pragma once

#include <atomic>
#include <cstddef>
#include <mutex>
#include <thread>

#include "tests/core/random.h"

namespace vsplit::test {

/// A way through the loopback to a server that breaks: the connection is cut whenever so many bytes have come down.
class CuttingProxy {
public:
    explicit CuttingProxy(int server_port);
    ~CuttingProxy();
    CuttingProxy(const CuttingProxy&) = delete;
    CuttingProxy& operator=(const CuttingProxy&) = delete;

    [[nodiscard]] int port() const { return port_; }
    /// From now on after `least` to `most` bytes, then again and again; 0 for never.
    void cut_every(std::size_t least, std::size_t most);
    /// Connections that were cut so far.
    [[nodiscard]] int cuts() const { return cuts_; }

private:
    void serve();
    void carry(int client);
    [[nodiscard]] bool is_due(std::size_t more);

    int listener_ = -1;
    int port_ = 0;
    const int server_port_;
    std::mutex mutex_;  // of the next four
    Random random_{11};
    std::size_t least_ = 0, most_ = 0;
    std::size_t left_ = 0;
    std::atomic<int> cuts_ = 0;
    std::atomic<bool> stop_ = false;
    std::thread thread_;
};

}  // namespace vsplit::test

#include "cutting_proxy.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <vector>

namespace vsplit::test {
namespace {

constexpr int kTickMs = 20;

sockaddr_in loopback(int port) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    return address;
}

bool write_all(int to, const char* bytes, std::size_t size) {
    while (size > 0) {
        const ssize_t sent = send(to, bytes, size, MSG_NOSIGNAL);
        if (sent <= 0) return false;
        bytes += sent;
        size -= static_cast<std::size_t>(sent);
    }
    return true;
}

}  // namespace

CuttingProxy::CuttingProxy(int server_port) : listener_(socket(AF_INET, SOCK_STREAM, 0)), server_port_(server_port) {
    sockaddr_in address = loopback(0);
    socklen_t size = sizeof(address);
    if (bind(listener_, reinterpret_cast<sockaddr*>(&address), size) == 0 && listen(listener_, 8) == 0 &&
        getsockname(listener_, reinterpret_cast<sockaddr*>(&address), &size) == 0)
        port_ = ntohs(address.sin_port);
    thread_ = std::thread([this] { serve(); });
}

CuttingProxy::~CuttingProxy() {
    stop_ = true;
    thread_.join();
    close(listener_);
}

/// A connection at a time: a client has one.
void CuttingProxy::serve() {
    while (!stop_) {
        pollfd ready{listener_, POLLIN, 0};
        if (poll(&ready, 1, kTickMs) <= 0) continue;
        const int client = accept(listener_, nullptr, nullptr);
        if (client < 0) continue;
        carry(client);
        close(client);
    }
}

void CuttingProxy::cut_every(std::size_t least, std::size_t most) {
    const std::lock_guard lock(mutex_);
    least_ = least;
    most_ = most;
    left_ = least + random_.below(static_cast<std::uint32_t>(most - least + 1));
}

bool CuttingProxy::is_due(std::size_t more) {
    const std::lock_guard lock(mutex_);
    if (most_ == 0) return false;
    if (more < left_) {
        left_ -= more;
        return false;
    }
    left_ = least_ + random_.below(static_cast<std::uint32_t>(most_ - least_ + 1));
    return true;
}

void CuttingProxy::carry(int client) {
    const int server = socket(AF_INET, SOCK_STREAM, 0);
    const sockaddr_in address = loopback(server_port_);
    if (connect(server, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) == 0) {
        std::array<char, 4096> buffer{};
        std::array<pollfd, 2> ready{pollfd{client, POLLIN, 0}, pollfd{server, POLLIN, 0}};
        bool open = true;
        while (open && !stop_) {
            if (poll(ready.data(), ready.size(), kTickMs) <= 0) continue;
            for (const auto& [from, to] : {std::pair(0, 1), std::pair(1, 0)}) {
                if (ready[from].revents == 0) continue;
                const ssize_t got = recv(ready[from].fd, buffer.data(), buffer.size(), 0);
                open = open && got > 0 && write_all(ready[to].fd, buffer.data(), static_cast<std::size_t>(got));
                if (from != 1 || got <= 0 || !is_due(static_cast<std::size_t>(got))) continue;
                ++cuts_;
                open = false;
            }
        }
    }
    close(server);
}

}  // namespace vsplit::test

#include "grpc/connection_door.h"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <chrono>
#include <cstdint>
#include <list>
#include <thread>
#include <utility>

namespace vsplit::rpc {
namespace {

namespace net = boost::asio;
using net::ip::tcp;
using ErrorCode = boost::system::error_code;

constexpr std::chrono::milliseconds kPause(100);  // where no more descriptors are to be had, for example

bool has_ended(int descriptor) {
    pollfd asked{descriptor, 0, 0};
    return poll(&asked, 1, 0) > 0 && (asked.revents & (POLLHUP | POLLERR | POLLNVAL)) != 0;
}

}  // namespace

// Everything but `port` and `stop` runs on its one thread.
class ConnectionDoor::Impl {
public:
    Impl(std::size_t limit, std::function<void()> on_refused) : limit_(limit), on_refused_(std::move(on_refused)) {}

    Status listen(const std::string& host, const std::string& port) {
        ErrorCode failed;
        tcp::resolver resolver(context_);
        const auto found = resolver.resolve(host, port, tcp::resolver::passive | tcp::resolver::numeric_service, failed);
        ErrorCode first_failure = failed;
        for (const auto& at : found) {
            tcp::endpoint endpoint = at.endpoint();
            if (port_ != 0) endpoint.port(port_);  // a free one: the same at every address
            listen_at(endpoint, failed);
            if (failed && !first_failure) first_failure = failed;
        }
        if (!acceptors_.empty()) return Done{};
        return Error{Cause::kUnavailable, "cannot listen on " + host + ':' + port + ": " + first_failure.message(), "listen"};
    }

    [[nodiscard]] int port() const { return port_; }

    void open(HandOver hand_over) {
        hand_over_ = std::move(hand_over);
        for (tcp::acceptor& acceptor : acceptors_) accept(acceptor);
        thread_ = std::thread([this] { context_.run(); });
    }

    void stop() {
        context_.stop();
        if (thread_.joinable()) thread_.join();
        acceptors_.clear();
        connections_.clear();
    }

private:
    using Watched = std::list<tcp::socket>::iterator;

    void listen_at(const tcp::endpoint& endpoint, ErrorCode& failed) {
        tcp::acceptor acceptor(context_);
        acceptor.open(endpoint.protocol(), failed);
        if (!failed) acceptor.set_option(net::socket_base::reuse_address(true), failed);
        if (!failed) acceptor.bind(endpoint, failed);
        if (!failed) acceptor.listen(net::socket_base::max_listen_connections, failed);
        if (failed) return;
        port_ = acceptor.local_endpoint().port();
        acceptors_.push_back(std::move(acceptor));
    }

    void accept(tcp::acceptor& acceptor) {
        acceptor.async_accept([this, &acceptor](const ErrorCode& failed, tcp::socket socket) {
            if (!failed) welcome(std::move(socket), acceptor.native_handle());
            if (!failed) return accept(acceptor);
            const auto pause = std::make_shared<net::steady_timer>(context_, kPause);
            pause->async_wait([this, &acceptor, pause](const ErrorCode& /*none*/) { accept(acceptor); });
        });
    }

    void welcome(tcp::socket socket, int listener) {
        if (limit_ != 0 && connections_.size() >= limit_) return on_refused_ ? on_refused_() : void();
        ErrorCode failed;
        socket.set_option(tcp::no_delay(true), failed);
        if (!failed) socket.native_non_blocking(true, failed);
        if (!failed) watch(socket, failed);
        if (failed) return;
        const int descriptor = socket.release(failed);
        if (!failed) hand_over_(descriptor, listener);
    }

    /// Keeps a second descriptor of the connection, to hear of its end.
    void watch(tcp::socket& socket, ErrorCode& failed) {
        const auto protocol = socket.local_endpoint(failed).protocol();
        if (failed) return;
        const int second = fcntl(socket.native_handle(), F_DUPFD_CLOEXEC, 0);
        if (second < 0) {
            failed = ErrorCode(errno, boost::system::system_category());
            return;
        }
        tcp::socket watched(context_);
        watched.assign(protocol, second, failed);
        if (failed) return static_cast<void>(::close(second));
        connections_.push_front(std::move(watched));
        wait_for_end(connections_.begin());
    }

    void wait_for_end(Watched connection) {
        connection->async_wait(tcp::socket::wait_error, [this, connection](const ErrorCode& failed) {
            // Urgent data is no end.
            if (!failed && !has_ended(connection->native_handle())) return wait_for_end(connection);
            connections_.erase(connection);
        });
    }

    const std::size_t limit_;
    const std::function<void()> on_refused_;
    std::uint16_t port_ = 0;
    HandOver hand_over_;
    net::io_context context_;
    std::list<tcp::acceptor> acceptors_;
    std::list<tcp::socket> connections_;
    std::thread thread_;
};

ConnectionDoor::ConnectionDoor(std::size_t limit, std::function<void()> on_refused)
    : impl_(std::make_unique<Impl>(limit, std::move(on_refused))) {}

ConnectionDoor::~ConnectionDoor() { close(); }

Status ConnectionDoor::listen(const std::string& host, const std::string& port) { return impl_->listen(host, port); }

int ConnectionDoor::port() const { return impl_->port(); }

void ConnectionDoor::open(HandOver hand_over) { impl_->open(std::move(hand_over)); }

void ConnectionDoor::close() { impl_->stop(); }

}  // namespace vsplit::rpc

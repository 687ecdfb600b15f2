#include "rest/rest_server.h"

#include <condition_variable>
#include <mutex>
#include <thread>
#include <unordered_set>
#include <utility>
#include <vector>

namespace vsplit::rest {

using net::ip::tcp;

// The threads, the socket that listens, and who is connected.
class RestServer::Listener {
public:
    Listener(std::shared_ptr<net::io_context> context, std::unique_ptr<Gateway> gateway, HttpObserver observer,
             std::shared_ptr<guard::TlsBook> tls, std::function<void()> on_refused)
        : context_(std::move(context)),
          gateway_(std::move(gateway)),
          observer_(std::move(observer)),
          tls_(std::move(tls)),
          on_refused_(std::move(on_refused)),
          work_(net::make_work_guard(*context_)),
          acceptor_(net::make_strand(*context_)),
          pause_(acceptor_.get_executor()) {}

    Status listen(const std::string& host, const std::string& port) {
        ErrorCode failed;
        tcp::resolver resolver(*context_);
        const auto found = resolver.resolve(host, port, tcp::resolver::passive | tcp::resolver::numeric_service, failed);
        if (!failed) acceptor_.open(found.begin()->endpoint().protocol(), failed);
        if (!failed) acceptor_.set_option(net::socket_base::reuse_address(true), failed);
        if (!failed) acceptor_.bind(found.begin()->endpoint(), failed);
        if (!failed) acceptor_.listen(net::socket_base::max_listen_connections, failed);
        if (failed) return Error{Cause::kUnavailable, "cannot listen on " + host + ':' + port + ": " + failed.message(), "http"};
        port_ = acceptor_.local_endpoint().port();
        return Done{};
    }

    void run(unsigned threads) {
        net::co_spawn(acceptor_.get_executor(), accept(), net::detached);
        for (unsigned i = 0; i < threads; ++i) threads_.emplace_back([this] { context_->run(); });
    }

    [[nodiscard]] int port() const { return port_; }

    /// Whoever connects from now on gets one answer: balancers and scrapers do so to learn how it stands.
    void drain() {
        const std::lock_guard lock(mutex_);
        draining_ = true;
        for (const auto& connection : connections_) connection->drain();
    }

    void shutdown(std::chrono::milliseconds grace) {
        if (threads_.empty()) return;
        net::post(acceptor_.get_executor(), [this] {
            ErrorCode ignored;
            acceptor_.close(ignored);
            pause_.cancel();
        });
        drain();
        std::unique_lock lock(mutex_);
        if (!empty_.wait_for(lock, grace, [this] { return connections_.empty() && !accepting_; })) {
            for (const auto& connection : connections_) connection->close();
            empty_.wait(lock, [this] { return connections_.empty() && !accepting_; });
        }
        lock.unlock();
        work_.reset();
        context_->stop();
        for (std::thread& thread : threads_) thread.join();
        threads_.clear();
    }

private:
    Awaitable<void> accept() {
        constexpr std::chrono::milliseconds kPause(100);
        while (acceptor_.is_open()) {
            ErrorCode failed;
            tcp::socket socket = co_await acceptor_.async_accept(net::make_strand(*context_), into(failed));
            if (!failed) {
                welcome(std::move(socket));
            } else if (acceptor_.is_open()) {  // no more descriptors, for example
                pause_.expires_after(kPause);
                co_await pause_.async_wait(into(failed));
            }
        }
        const std::lock_guard lock(mutex_);
        accepting_ = false;
        empty_.notify_all();
    }

    void welcome(tcp::socket socket) {
        const bool room = has_place();
        if (!room && on_refused_) on_refused_();
        if (!room && !begin_refusal()) return;  // which closes it
        const auto executor = socket.get_executor();
        const auto connection =
            std::make_shared<Connection>(std::move(socket), tls_ ? tls_->current()->context : nullptr, *gateway_, observer_);
        {
            const std::lock_guard lock(mutex_);
            connections_.insert(connection);
            if (draining_) connection->serve_one_only();
        }
        net::co_spawn(executor, room ? connection->run() : connection->refuse(),
                      [this, connection, room](const std::exception_ptr& /*bad_alloc*/) { leave(connection, room); });
    }

    bool has_place() {
        const std::lock_guard lock(mutex_);
        return connections_.size() - refusals_ < gateway_->limits().connections;
    }

    /// Whether one that has no place may be told so: it takes a descriptor and memory meanwhile, and is in no hurry perhaps.
    bool begin_refusal() {
        constexpr std::size_t kMost = 32;
        const std::lock_guard lock(mutex_);
        if (refusals_ >= kMost) return false;
        ++refusals_;
        return true;
    }

    void leave(const std::shared_ptr<Connection>& connection, bool had_place) {
        const std::lock_guard lock(mutex_);
        if (!had_place) --refusals_;
        connections_.erase(connection);
        if (connections_.empty()) empty_.notify_all();
    }

    const std::shared_ptr<net::io_context> context_;
    const std::unique_ptr<Gateway> gateway_;
    const HttpObserver observer_;
    const std::shared_ptr<guard::TlsBook> tls_;
    const std::function<void()> on_refused_;
    net::executor_work_guard<net::io_context::executor_type> work_;
    tcp::acceptor acceptor_;
    net::steady_timer pause_;
    int port_ = 0;
    std::vector<std::thread> threads_;

    std::mutex mutex_;
    std::condition_variable empty_;
    std::unordered_set<std::shared_ptr<Connection>> connections_;
    std::size_t refusals_ = 0;  // of the connections, those that are turned away
    bool draining_ = false;
    bool accepting_ = true;
};

Expected<std::unique_ptr<RestServer>> RestServer::start(const std::string& host, const std::string& port, Backend backend,
                                                        RestOptions options, HttpObserver observer,
                                                        std::shared_ptr<guard::TlsBook> tls) {
    auto context = std::make_shared<net::io_context>();
    const unsigned threads = options.threads;
    auto on_refused = options.on_connection_refused;
    Expected<std::unique_ptr<Gateway>> gateway = Gateway::make(std::move(backend), std::move(options));
    if (!gateway) return gateway.error();
    auto listener = std::make_shared<Listener>(std::move(context), *std::move(gateway), std::move(observer), std::move(tls),
                                               std::move(on_refused));
    if (Status listening = listener->listen(host, port); !listening) return listening.error();
    listener->run(threads);
    return std::unique_ptr<RestServer>(new RestServer(std::move(listener)));
}

RestServer::~RestServer() { shutdown(std::chrono::milliseconds(0)); }

int RestServer::port() const { return listener_->port(); }

void RestServer::drain() { listener_->drain(); }

void RestServer::shutdown(std::chrono::milliseconds grace) { listener_->shutdown(grace); }

}  // namespace vsplit::rest

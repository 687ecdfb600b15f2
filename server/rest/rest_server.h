#pragma once

#include <chrono>
#include <memory>
#include <string>

#include "guard/tls_book.h"
#include "rest/connection.h"
#include "rest/gateway.h"
#include "rest/rest_options.h"
#include "vsplit/base/expected.h"

namespace vsplit::rest {

/// The REST front door: HTTP/1.1 in front of the rpcs of a gRPC server, which must be shut down after it.
class RestServer {
public:
    /// Serves at `host`:`port` (0 for a free one) from now on. \return UNAVAILABLE when it cannot listen there, with the reason;
    /// what Gateway::make returns.
    [[nodiscard]] static Expected<std::unique_ptr<RestServer>> start(const std::string& host, const std::string& port,
                                                                     Backend backend, RestOptions options, HttpObserver observer,
                                                                     std::shared_ptr<guard::TlsBook> tls = nullptr);
    ~RestServer();
    RestServer(const RestServer&) = delete;
    RestServer& operator=(const RestServer&) = delete;

    [[nodiscard]] int port() const;

    /// Takes no more connections, closes those that are idle, and the others when their request is answered.
    void drain();

    /// drain, gives what is being answered `grace` to end, and cuts off the rest. Once.
    void shutdown(std::chrono::milliseconds grace);

private:
    class Listener;

    explicit RestServer(std::shared_ptr<Listener> listener) : listener_(std::move(listener)) {}

    const std::shared_ptr<Listener> listener_;
};

}  // namespace vsplit::rest

#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>

#include "vsplit/base/expected.h"

namespace vsplit::rpc {

/// Listens for a gRPC server, which of itself takes any number of connections: takes so many at a time and closes more at once,
/// which their clients call UNAVAILABLE. (HTTP/2's GOAWAY has them try again until their deadline.) Has one thread.
class ConnectionDoor {
public:
    /// Takes a connection over: whoever gets the descriptor closes it. `listener` is the socket it came by.
    using HandOver = std::function<void(int descriptor, int listener)>;

    /// \param limit connections at a time; 0: no limit. \param on_refused called for each that is over it; may be empty.
    ConnectionDoor(std::size_t limit, std::function<void()> on_refused);
    ~ConnectionDoor();
    ConnectionDoor(const ConnectionDoor&) = delete;
    ConnectionDoor& operator=(const ConnectionDoor&) = delete;

    /// At `host`:`port`, at every address the host has; 0 for a free port. \return UNAVAILABLE with the reason.
    [[nodiscard]] Status listen(const std::string& host, const std::string& port);

    [[nodiscard]] int port() const;

    /// Hands connections over from now on. \pre listens.
    void open(HandOver hand_over);

    /// Takes no more. Once.
    void close();

private:
    class Impl;

    const std::unique_ptr<Impl> impl_;
};

}  // namespace vsplit::rpc

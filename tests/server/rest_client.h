#pragma once

#include <chrono>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "rest/asio.h"
#include "rest/rest_server.h"
#include "test_server.h"

/// What tests say to a server over HTTP.
namespace vsplit::test {

struct HttpReply {
    unsigned status = 0;                        ///< 0: no answer came
    std::map<std::string, std::string> fields;  ///< by name as it was written
    std::string body;
    bool whole = false;  ///< the answer came to its end
};

using Fields = std::vector<std::pair<std::string, std::string>>;

/// One connection, kept open.
class HttpClient {
public:
    explicit HttpClient(int port);

    /// Sends the request and reads its answer.
    [[nodiscard]] HttpReply ask(const std::string& method, const std::string& target, const Fields& fields = {},
                                const std::string& body = "");

    /// Sends the request only.
    void begin(const std::string& method, const std::string& target, const Fields& fields = {}, const std::string& body = "");

    void send(std::string_view bytes);
    [[nodiscard]] HttpReply read_reply(bool to_head = false);

    /// Reads one line, without its end; empty at the end.
    [[nodiscard]] std::string read_line();

    void close();

private:
    rest::net::io_context context_;
    rest::net::ip::tcp::socket socket_;
    rest::beast::flat_buffer buffer_;
};

/// One request on a connection of its own.
[[nodiscard]] HttpReply ask(int port, const std::string& method, const std::string& target, const Fields& fields = {},
                            const std::string& body = "");

/// A server with both doors.
class RestFixture {
public:
    explicit RestFixture(const service::ServiceOptions& options = small_server(), rest::RestOptions rest_options = {},
                         const rpc::GrpcExtras& extras = {});

    [[nodiscard]] int port() const { return rest_->port(); }
    [[nodiscard]] TestServer& grpc() { return grpc_; }
    [[nodiscard]] rest::RestServer& rest() { return *rest_; }

private:
    TestServer grpc_;
    std::unique_ptr<rest::RestServer> rest_;
};

/// The field of a JSON object's text; for nested ones a JSON pointer like "/source/faces". Fails the test where it is not there.
[[nodiscard]] std::string json_at(const std::string& text, const std::string& pointer);

}  // namespace vsplit::test

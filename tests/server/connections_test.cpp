#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <memory>
#include <string>
#include <vector>

#include "test_client.h"
#include "test_server.h"

namespace vsplit::test {
namespace {

using boost::asio::ip::tcp;
using ::testing::HasSubstr;

rpc::GrpcExtras room_for(std::size_t connections, std::atomic<int>* refused = nullptr) {
    rpc::GrpcExtras extras;
    extras.limits.connections = connections;
    if (refused != nullptr) extras.on_connection_refused = [refused] { ++*refused; };
    return extras;
}

// Channels to one server share a connection unless they are told not to.
std::shared_ptr<grpc::Channel> channel_of_its_own(const TestServer& server, const std::string& host = "127.0.0.1") {
    grpc::ChannelArguments arguments;
    arguments.SetInt(GRPC_ARG_USE_LOCAL_SUBCHANNEL_POOL, 1);
    const std::string target = host + ':' + std::to_string(server.port());
    return grpc::CreateCustomChannel(target, grpc::InsecureChannelCredentials(), arguments);
}

grpc::Status ask(const std::shared_ptr<grpc::Channel>& channel) {
    const auto stub = v1::Meshing::NewStub(channel);
    v1::ListSessionsResponse response;
    return stub->ListSessions(call(std::chrono::seconds(20)).get(), {}, &response);
}

tcp::socket connected(boost::asio::io_context& context, int port) {
    tcp::socket socket(context);
    socket.connect({boost::asio::ip::address_v4::loopback(), static_cast<std::uint16_t>(port)});
    return socket;
}

TEST(ConnectionsTest, OverTheLimitAreTurnedAwayAtOnce) {
    std::atomic<int> refusals = 0;
    TestServer server(small_server(), room_for(2, &refusals));
    const auto first = channel_of_its_own(server), second = channel_of_its_own(server), third = channel_of_its_own(server);
    EXPECT_TRUE(ask(first).ok());
    EXPECT_TRUE(ask(second).ok());
    const grpc::Status refused = ask(third);
    EXPECT_EQ(refused.error_code(), grpc::StatusCode::UNAVAILABLE);
    EXPECT_GE(refusals, 1);
    EXPECT_TRUE(ask(first).ok()) << "those who are in are not disturbed";
}

TEST(ConnectionsTest, WhoLeavesMakesRoom) {
    TestServer server(small_server(), room_for(1));
    for (int i = 0; i < 20; ++i) {
        EXPECT_TRUE(eventually([&] { return ask(channel_of_its_own(server)).ok(); })) << i;
    }
}

TEST(ConnectionsTest, SilentOnesCountToo) {
    TestServer server(small_server(), room_for(50));
    boost::asio::io_context context;
    std::vector<tcp::socket> silent;
    for (int i = 0; i < 50; ++i) silent.push_back(connected(context, server.port()));
    EXPECT_FALSE(ask(channel_of_its_own(server)).ok());
    silent.clear();
    EXPECT_TRUE(eventually([&] { return ask(channel_of_its_own(server)).ok(); }));
}

TEST(ConnectionsTest, SilentOnesAreCutOff) {
    rpc::GrpcExtras extras = room_for(50);
    extras.life.handshake = std::chrono::seconds(1);
    TestServer server(small_server(), extras);
    boost::asio::io_context context;
    std::vector<tcp::socket> silent;
    for (int i = 0; i < 50; ++i) {
        silent.push_back(connected(context, server.port()));
        // Some begin, and say no more than HTTP/2's first words.
        if (i % 2 == 0) silent.back().send(boost::asio::buffer(std::string("PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n")));
    }
    EXPECT_FALSE(ask(channel_of_its_own(server)).ok());
    EXPECT_TRUE(eventually([&] { return ask(channel_of_its_own(server)).ok(); }));
}

TEST(ConnectionsTest, UrgentDataIsNoEnd) {
    TestServer server(small_server(), room_for(1));
    boost::asio::io_context context;
    tcp::socket silent = connected(context, server.port());
    silent.send(boost::asio::buffer("!", 1), tcp::socket::message_out_of_band);
    EXPECT_FALSE(ask(channel_of_its_own(server)).ok());
    silent.close();
    EXPECT_TRUE(eventually([&] { return ask(channel_of_its_own(server)).ok(); }));
}

TEST(ConnectionsTest, AFloodIsCutOffAndTheServerGoesOn) {
    TestServer server(small_server(), room_for(1));
    const auto held = channel_of_its_own(server);
    ASSERT_TRUE(ask(held).ok());
    boost::asio::io_context context;
    for (int i = 0; i < 500; ++i) {
        tcp::socket socket = connected(context, server.port());
        if (i % 2 == 0) socket.close();
    }
    EXPECT_TRUE(ask(held).ok());
}

TEST(ConnectionsTest, APortThatIsTakenIsNamedWithTheReason) {
    TestServer server;
    service::MeshingService service(small_server());
    const auto second = rpc::GrpcServer::start("127.0.0.1", std::to_string(server.port()), service, {});
    ASSERT_FALSE(second);
    EXPECT_EQ(second.error().cause, Cause::kUnavailable);
    EXPECT_THAT(second.error().message, HasSubstr("cannot listen on 127.0.0.1:" + std::to_string(server.port())));
    EXPECT_THAT(second.error().message, HasSubstr("ddress already in use"));
}

TEST(ConnectionsTest, AHostIsServedAtEachOfItsAddresses) {
    service::MeshingService service(small_server());
    const auto server = rpc::GrpcServer::start("localhost", "0", service, {});
    ASSERT_TRUE(server) << server.error().message;
    boost::asio::io_context context;
    tcp::resolver resolver(context);
    for (const auto& at : resolver.resolve("localhost", std::to_string((*server)->port()))) {
        boost::system::error_code failed;
        tcp::socket(context).connect(at.endpoint(), failed);
        EXPECT_FALSE(failed) << at.endpoint().address() << ": " << failed.message();
    }
}

}  // namespace
}  // namespace vsplit::test

#include "test_server.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <iostream>
#include <thread>
#include <utility>

#include "test_client.h"
#include "wire/error_table.h"

namespace vsplit::test {

service::ServiceOptions small_server() {
    service::ServiceOptions options;
    options.workers = 2;
    options.threads = 1;
    return options;
}

TestServer::TestServer(const service::ServiceOptions& options, rpc::GrpcExtras extras) : service_(options) {
    extras.observer = [this](const rpc::RpcRecord& record) { note(record); };
    Expected<std::unique_ptr<rpc::GrpcServer>> server = rpc::GrpcServer::start("127.0.0.1", "0", service_, extras);
    if (!server) {
        std::cerr << server.error().message << '\n';
        std::abort();  // no test can say anything without a server
    }
    server_ = *std::move(server);
}

TestServer::~TestServer() { server_->shutdown(std::chrono::milliseconds(0)); }

v1::Meshing::Stub& TestServer::stub() {
    std::call_once(connected_, [this] { stub_ = connect(); });
    return *stub_;
}

std::unique_ptr<v1::Meshing::Stub> TestServer::connect() const {
    grpc::ChannelArguments arguments;
    arguments.SetInt(GRPC_ARG_USE_LOCAL_SUBCHANNEL_POOL, 1);  // a connection of its own, not one shared with other stubs
    const std::string address = "127.0.0.1:" + std::to_string(server_->port());
    return v1::Meshing::NewStub(connected(grpc::CreateCustomChannel(address, grpc::InsecureChannelCredentials(), arguments)));
}

std::vector<std::string> TestServer::finished() const {
    const std::lock_guard lock(mutex_);
    return finished_;
}

void TestServer::note(const rpc::RpcRecord& record) {
    const std::string outcome = record.status.ok() ? "OK" : std::string(cause_name(wire::from_status(record.status).cause));
    const std::lock_guard lock(mutex_);
    finished_.push_back(std::string(record.method) + ' ' + outcome);
}

BlockedErrands::BlockedErrands(service::MeshingService& service) {
    const unsigned threads = std::max(2U, std::thread::hardware_concurrency());
    const std::shared_future<void> opened = open_.get_future().share();
    const auto running = std::make_shared<std::atomic<unsigned>>(0);
    for (unsigned i = 0; i < threads; ++i) {
        EXPECT_TRUE(service.errand([opened, running] {
            ++*running;
            opened.wait();
        }));
    }
    while (*running < threads) std::this_thread::yield();
}

}  // namespace vsplit::test

// An rpc that nobody told the gateway of.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "rest_client.h"
#include "rest_probe.grpc.pb.h"
#include "rest_probe_bytes.h"

namespace vsplit::test {
namespace {

class ProbeService final : public Probe::Service {
public:
    grpc::Status Greet(grpc::ServerContext* /*context*/, const GreetRequest* request, GreetReply* reply) override {
        for (int i = 0; i <= request->details().times(); ++i) reply->set_text(reply->text() + "hello " + request->name());
        return {};
    }

    grpc::Status Count(grpc::ServerContext* /*context*/, const CountRequest* request,
                       grpc::ServerWriter<CountReply>* writer) override {
        for (int i = 1; i <= request->up_to(); ++i) {
            CountReply reply;
            reply.set_number(i);
            writer->Write(reply);
        }
        if (request->up_to() > 5) return {grpc::StatusCode::OUT_OF_RANGE, "that is too far"};
        return {};
    }
};

class NewRpcTest : public ::testing::Test {
protected:
    void SetUp() override {
        auto grpc = rpc::GrpcServer::start("127.0.0.1", "0", meshing_, {{}, nullptr, {&probe_}});
        ASSERT_TRUE(grpc);
        grpc_ = *std::move(grpc);
        rest::Backend backend;
        backend.channel = grpc_->channel();
        backend.descriptor_sets = {rest::contract_descriptors(), probe_descriptors()};
        backend.services = {v1::Meshing::service_full_name(), Probe::service_full_name()};
        auto rest = rest::RestServer::start("127.0.0.1", "0", std::move(backend), {}, {});
        ASSERT_TRUE(rest) << rest.error().message;
        rest_ = *std::move(rest);
    }

    HttpReply ask(const std::string& method, const std::string& target, const Fields& fields = {}, const std::string& body = "") {
        return test::ask(rest_->port(), method, target, fields, body);
    }

    service::MeshingService meshing_{small_server()};
    ProbeService probe_;
    std::unique_ptr<rpc::GrpcServer> grpc_;
    std::unique_ptr<rest::RestServer> rest_;
};

TEST_F(NewRpcTest, IsReached) {
    EXPECT_EQ(json_at(ask("GET", "/v1/probes/you").body, "/text"), "hello you");
    EXPECT_EQ(json_at(ask("GET", "/v1/probes/you?details.times=1").body, "/text"), "hello youhello you");
    EXPECT_EQ(json_at(ask("PUT", "/v1/probes?name=me", {{"Content-Type", "application/json"}}, R"({"times": 1})").body, "/text"),
              "hello mehello me");
    EXPECT_EQ(ask("GET", "/v1/sessions").status, 200U) << "the contract is served as well";
}

TEST_F(NewRpcTest, StreamsAsAcceptAsks) {
    EXPECT_EQ(json_at(ask("POST", "/v1/probes/x:count?upTo=3").body, "/number"), "3") << "the last word";
    EXPECT_EQ(ask("POST", "/v1/probes/x:count?upTo=3", {{"Accept", "application/x-ndjson"}}).body,
              "{\"number\":1}\n{\"number\":2}\n{\"number\":3}\n");
    const HttpReply failed = ask("POST", "/v1/probes/x:count?upTo=6", {{"Accept", "application/x-vsplit"}});
    EXPECT_FALSE(failed.whole) << "a stream without a word for errors is cut off";
    EXPECT_EQ(json_at(ask("POST", "/v1/probes/x:count?upTo=6").body, "/detail"), "that is too far");
}

TEST_F(NewRpcTest, IsDescribedWithItsComments) {
    const nlohmann::json document = nlohmann::json::parse(ask("GET", "/openapi.json").body);
    const nlohmann::json& greet = document["paths"]["/v1/probes/{name}"]["get"];
    EXPECT_EQ(greet["summary"], "Greets whom the path names");
    EXPECT_EQ(document["components"]["schemas"]["GreetReply"]["properties"]["text"]["description"], "The words.");
    EXPECT_TRUE(
        document["paths"]["/v1/probes/{name}:count"]["post"]["responses"]["200"]["content"].contains("application/x-ndjson"));
    EXPECT_EQ(document.dump().find("Hidden"), std::string::npos);
}

}  // namespace
}  // namespace vsplit::test

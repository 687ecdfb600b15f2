// What methods may take of the server, and that the same one is not done twice.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "test_client.h"
#include "test_server.h"
#include "tests/core/meshes.h"

namespace vsplit::test {
namespace {

using ::testing::HasSubstr;

TEST(BoundedWorkTest, AMethodEndsWhenItsTimeIsOver) {
    service::ServiceOptions options = small_server();
    options.limits.job_seconds = 1;
    TestServer server(options);
    const std::string session = session_with(server.stub(), bumpy_sphere(2, 0.05, 7));
    const Received received = improve(server.stub(), long_improve(session));
    EXPECT_EQ(received.status.error_code(), grpc::StatusCode::RESOURCE_EXHAUSTED);
    EXPECT_THAT(received.status.error_message(), HasSubstr("max_job_seconds"));
    EXPECT_TRUE(improve(server.stub(), small_improve(session)).status.ok());
}

TEST(BoundedWorkTest, AMethodThatMemoryHasNoRoomForIsRefusedBeforeItTakesAny) {
    service::ServiceOptions options = small_server();
    options.limits.memory_bytes = 2 << 20;
    TestServer server(options);
    const std::string session = session_with(server.stub(), bumpy_sphere(2, 0.05, 7));
    const Received received = improve(server.stub(), long_improve(session));
    EXPECT_EQ(received.status.error_code(), grpc::StatusCode::RESOURCE_EXHAUSTED);
    EXPECT_THAT(received.status.error_message(), HasSubstr("max_memory_bytes"));
    EXPECT_TRUE(improve(server.stub(), small_improve(session)).status.ok());
    EXPECT_LE(server.service().memory().use().bytes, options.limits.memory_bytes);
}

TEST(BoundedWorkTest, WhatARequestHoldsCountsAsWell) {
    TestServer server;
    const TriangleMesh mesh = bumpy_sphere(2, 0.05, 7);
    const std::string session = session_with(server.stub(), mesh);
    v1::ImproveRequest large = small_improve(session);
    for (std::uint32_t i = 0; i < 600'000; ++i) large.mutable_options()->add_marked_edges(mesh.faces[0][i % 2]);
    const Received received = improve(server.stub(), large);
    ASSERT_TRUE(received.status.ok()) << received.status.error_message();
    EXPECT_GT(server.service().memory().use().bytes, 2'400'000U);
}

TEST(BoundedWorkTest, AMeshThatMemoryHasNoRoomForIsRefused) {
    service::ServiceOptions options = small_server();
    options.limits.memory_bytes = 1 << 20;
    TestServer server(options);
    const Reply<v1::Session> refused = create_session(server.stub(), file_of(icosphere(6)));
    EXPECT_EQ(refused.status.error_code(), grpc::StatusCode::RESOURCE_EXHAUSTED);
    EXPECT_THAT(refused.status.error_message(), HasSubstr("max_memory_bytes"));
    EXPECT_TRUE(create_session(server.stub(), file_of(cube())).status.ok());
}

/// A polygon of so many corners at `corners` positions that one face takes a byte of the file.
std::string fan(std::uint32_t corners) {
    std::string file =
        "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
        "element face 1\nproperty list uint uchar vertex_indices\nend_header\n";
    const float positions[] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    file.append(reinterpret_cast<const char*>(positions), sizeof positions);
    file.append(reinterpret_cast<const char*>(&corners), sizeof corners);
    for (std::uint32_t i = 0; i < corners; ++i) file += static_cast<char>(i == 0 ? 0 : 1 + i % 2);
    return file;
}

// Its size says little of its faces: a hundred thousand of 150 bytes each are 15 MB.
TEST(BoundedWorkTest, APolygonOfManyCornersIsRefusedLikeItsFaces) {
    service::ServiceOptions options = small_server();
    options.limits.memory_bytes = 4 << 20;
    TestServer server(options);
    const Reply<v1::Session> refused = create_session(server.stub(), fan(100'000));
    EXPECT_EQ(refused.status.error_code(), grpc::StatusCode::RESOURCE_EXHAUSTED);
    EXPECT_THAT(refused.status.error_message(), HasSubstr("max_memory_bytes"));
    const Reply<v1::Session> read = create_session(server.stub(), fan(5'000));
    EXPECT_THAT(read.status.error_message(), ::testing::Not(HasSubstr("max_")));
}

// So are vertices that no face has.
TEST(BoundedWorkTest, VerticesCountLikeFaces) {
    service::ServiceOptions options = small_server();
    options.limits.memory_bytes = 4 << 20;
    options.limits.faces = 100'000;
    TestServer server(options);
    std::string file;
    for (int i = 0; i < 290'000; ++i) file += "v 1 1 1\n";
    file += "f 1 2 3\n";
    const Reply<v1::Session> refused = create_session(server.stub(), file);
    EXPECT_EQ(refused.status.error_code(), grpc::StatusCode::RESOURCE_EXHAUSTED);
    EXPECT_THAT(refused.status.error_message(), HasSubstr("max_memory_bytes"));
    for (int i = 0; i < 20'000; ++i) file += "v 1 1 1\n";
    options.limits.memory_bytes = 64 << 20;
    TestServer larger(options);
    const Reply<v1::Session> many = create_session(larger.stub(), file);
    EXPECT_EQ(many.status.error_code(), grpc::StatusCode::RESOURCE_EXHAUSTED);
    EXPECT_THAT(many.status.error_message(), HasSubstr("limit of 100000, the server's max_faces"));
}

TEST(BoundedWorkTest, FilesThatMemoryHasNoRoomForAreRefused) {
    service::ServiceOptions options = small_server();
    options.limits.memory_bytes = 4 << 20;
    TestServer server(options);
    const std::string session = session_with(server.stub(), icosphere(5));  // 20,480 faces: 3.8 MB to read, 5.1 MB to write
    const auto file = download(server.stub(), session);
    EXPECT_EQ(file.status.error_code(), grpc::StatusCode::RESOURCE_EXHAUSTED);
    EXPECT_THAT(file.status.error_message(), HasSubstr("max_memory_bytes"));
    EXPECT_TRUE(get_session(server.stub(), session).status.ok());
    const std::string small = session_with(server.stub(), icosphere(2));
    EXPECT_TRUE(download(server.stub(), small).status.ok());
}

class SameRequestTest : public ::testing::Test {
protected:
    std::size_t representations() { return get_session(server_.stub(), session_).message.representations_size(); }

    TestServer server_;
    const std::string session_ = session_with(server_.stub(), bumpy_sphere(2, 0.05, 7));
};

TEST_F(SameRequestTest, FindsWhatWasMade) {
    const Received first = improve(server_.stub(), small_improve(session_));
    const Received again = improve(server_.stub(), small_improve(session_));
    ASSERT_TRUE(first.status.ok() && again.status.ok());
    EXPECT_EQ(again.representation->DebugString(), first.representation->DebugString()) << "the time it took as well";
    EXPECT_EQ(again.mesh->mesh(), first.mesh->mesh());
    EXPECT_EQ(representations(), 1U);
}

TEST_F(SameRequestTest, AnyOtherIsDone) {
    v1::ImproveRequest request = small_improve(session_);
    ASSERT_TRUE(improve(server_.stub(), request).status.ok());
    request.mutable_options()->set_feature_weight(3);
    EXPECT_EQ(improve(server_.stub(), request).representation->id(), "r2");
    request.mutable_source()->set_representation("r1");
    EXPECT_EQ(improve(server_.stub(), request).representation->id(), "r3");
    request.mutable_source()->set_faces(improve(server_.stub(), small_improve(session_)).representation->faces());
    EXPECT_EQ(improve(server_.stub(), request).representation->id(), "r3") << "that is the resolution which r1 was made for";
    request.mutable_source()->set_faces(request.source().faces() - 2);
    EXPECT_EQ(improve(server_.stub(), request).representation->id(), "r4");
}

TEST_F(SameRequestTest, AnotherMeshIsAnotherRequest) {
    ASSERT_TRUE(improve(server_.stub(), small_improve(session_)).status.ok());
    ASSERT_TRUE(upload(server_.stub(), session_, file_of(bumpy_sphere(2, 0.05, 8))).status.ok());
    EXPECT_EQ(improve(server_.stub(), small_improve(session_)).representation->id(), "r2");
}

TEST_F(SameRequestTest, IsAnsweredWhereNothingNewMayBeMade) {
    service::ServiceOptions options = small_server();
    options.limits.representations = 1;
    TestServer server(options);
    const std::string session = session_with(server.stub(), bumpy_sphere(2, 0.05, 7));
    ASSERT_TRUE(improve(server.stub(), small_improve(session)).status.ok());
    EXPECT_TRUE(improve(server.stub(), small_improve(session)).status.ok());
    v1::ImproveRequest other = small_improve(session);
    other.mutable_source()->set_representation("r1");
    const Received refused = improve(server.stub(), other);
    EXPECT_EQ(refused.status.error_code(), grpc::StatusCode::RESOURCE_EXHAUSTED);
    EXPECT_THAT(refused.status.error_message(), HasSubstr("max_representations"));
}

TEST_F(SameRequestTest, KeepAlivePutsOffTheEndAndChangesNothing) {
    const v1::Session before = get_session(server_.stub(), session_).message;
    v1::KeepAliveRequest request;
    request.set_session(session_);
    v1::Session after;
    ASSERT_TRUE(server_.stub().KeepAlive(call().get(), request, &after).ok());
    EXPECT_GE(after.expire_time().seconds(), before.expire_time().seconds());
    *after.mutable_expire_time() = before.expire_time();
    EXPECT_EQ(after.DebugString(), before.DebugString());
}

}  // namespace
}  // namespace vsplit::test

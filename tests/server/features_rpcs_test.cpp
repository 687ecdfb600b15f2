#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "service/session_features.h"
#include "test_client.h"
#include "test_server.h"
#include "tests/core/drilled_plate.h"
#include "tests/core/filleted_parts.h"
#include "tests/core/meshes.h"

namespace vsplit::test {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

// Two through holes of 4 and 2, a blind one of 3.
TriangleMesh plate() { return drilled_plate(3, 10, 4, {{4, 4, 24}, {3, 2, 24}, {2, 4, 24}}); }

Reply<v1::ListFeaturesResponse> list(TestServer& server, const std::string& session) {
    v1::ListFeaturesRequest request;
    request.set_session(session);
    Reply<v1::ListFeaturesResponse> reply;
    grpc::ClientContext context;
    reply.status = server.stub().ListFeatures(&context, request, &reply.message);
    return reply;
}

Reply<v1::RemoveFeaturesResponse> remove(TestServer& server, const v1::RemoveFeaturesRequest& request) {
    Reply<v1::RemoveFeaturesResponse> reply;
    grpc::ClientContext context;
    reply.status = server.stub().RemoveFeatures(&context, request, &reply.message);
    return reply;
}

v1::RemoveFeaturesRequest all_under(const std::string& session, double diameter) {
    v1::RemoveFeaturesRequest request;
    request.set_session(session);
    request.set_max_diameter(diameter);
    return request;
}

TEST(FeaturesRpcsTest, ListsHolesWithTheirSizes) {
    TestServer server;
    const auto listed = list(server, session_with(server.stub(), plate()));
    ASSERT_TRUE(listed.status.ok()) << listed.status.error_message();
    ASSERT_EQ(listed.message.features_size(), 3);
    int blind = 0;
    for (const v1::ShapeFeature& f : listed.message.features()) {
        EXPECT_EQ(static_cast<int>(f.face_count()), f.faces_size());
        if (f.kind() != v1::ShapeFeature::BLIND_HOLE) continue;
        ++blind;
        EXPECT_NEAR(f.diameter(), 3, 0.03);
        EXPECT_NEAR(f.depth(), 2, 1e-5);
    }
    EXPECT_EQ(blind, 1);
    EXPECT_THAT(server.finished(), Contains("ListFeatures OK"));
}

TEST(FeaturesRpcsTest, TheResultIsTheSessionsMesh) {
    TestServer server;
    const std::string session = session_with(server.stub(), plate());
    const auto done = remove(server, all_under(session, 3.5));
    ASSERT_TRUE(done.status.ok()) << done.status.error_message();
    EXPECT_EQ(done.message.removed_size(), 2);
    EXPECT_EQ(done.message.kept_size(), 0);
    EXPECT_GT(done.message.source().faces(), done.message.first_new_face());
    EXPECT_EQ(done.message.source().genus(), 1);
    const auto now = get_session(server.stub(), session);
    ASSERT_TRUE(now.status.ok());
    EXPECT_EQ(now.message.source().faces(), done.message.source().faces());
    EXPECT_EQ(list(server, session).message.features_size(), 1);
}

TEST(FeaturesRpcsTest, RemovesById) {
    TestServer server;
    const std::string session = session_with(server.stub(), plate());
    v1::RemoveFeaturesRequest request;
    request.set_session(session);
    request.add_ids(1);
    const auto done = remove(server, request);
    ASSERT_TRUE(done.status.ok()) << done.status.error_message();
    EXPECT_THAT(done.message.removed(), ElementsAre(1U));
    EXPECT_EQ(list(server, session).message.features_size(), 2);
}

TEST(FeaturesRpcsTest, ListsAndChamfersFillets) {
    TestServer server;
    const std::string session = session_with(server.stub(), rounded_block(2, 8, 40));
    const auto listed = list(server, session);
    ASSERT_EQ(listed.message.features_size(), 1);
    const v1::ShapeFeature& fillet = listed.message.features(0);
    EXPECT_EQ(fillet.kind(), v1::ShapeFeature::FILLET);
    EXPECT_NEAR(fillet.diameter(), 4, 0.001);
    EXPECT_NEAR(fillet.depth(), 40, 1e-4);
    v1::RemoveFeaturesRequest request = all_under(session, 5);
    request.add_kinds(v1::ShapeFeature::THROUGH_HOLE);
    EXPECT_EQ(remove(server, request).message.removed_size(), 0);
    request.add_kinds(v1::ShapeFeature::FILLET);
    EXPECT_THAT(remove(server, request).message.removed(), ElementsAre(0U));
    EXPECT_EQ(list(server, session).message.features_size(), 0);
}

TEST(FeaturesRpcsTest, KindsThatAreNoneOrHoldForNothingAreRefused) {
    TestServer server;
    const std::string session = session_with(server.stub(), plate());
    v1::RemoveFeaturesRequest unknown = all_under(session, 5);
    unknown.add_kinds(v1::ShapeFeature::KIND_UNSPECIFIED);
    const auto refused = remove(server, unknown);
    EXPECT_TRUE(failed_with(refused.status, Cause::kInvalidOption, "kinds"));
    EXPECT_THAT(refused.status.error_message(), HasSubstr("accepted are THROUGH_HOLE, BLIND_HOLE, BOSS and FILLET"));
    v1::RemoveFeaturesRequest alone;
    alone.set_session(session);
    alone.add_ids(0);
    alone.add_kinds(v1::ShapeFeature::BOSS);
    EXPECT_THAT(remove(server, alone).status.error_message(), HasSubstr("max_diameter"));
    EXPECT_EQ(list(server, session).message.features_size(), 3);
}

TEST(FeaturesRpcsTest, RefusalsChangeNothing) {
    TestServer server;
    const std::string session = session_with(server.stub(), plate());
    v1::RemoveFeaturesRequest unknown;
    unknown.set_session(session);
    unknown.add_ids(7);
    const auto refused = remove(server, unknown);
    EXPECT_EQ(refused.status.error_code(), grpc::StatusCode::INVALID_ARGUMENT);
    EXPECT_THAT(refused.status.error_message(), HasSubstr("feature 7"));
    v1::RemoveFeaturesRequest nothing;
    nothing.set_session(session);
    EXPECT_EQ(remove(server, nothing).status.error_code(), grpc::StatusCode::INVALID_ARGUMENT);
    EXPECT_EQ(list(server, session).message.features_size(), 3);
}

TEST(FeaturesRpcsTest, WhoDoesNotWaitChangesNothing) {
    TestServer server;
    const std::string session = session_with(server.stub(), plate());
    FeatureRemoval removal;
    removal.max_diameter = 10;
    const auto removed = service::remove_features_of(server.service(), session, removal, [] { return false; });
    ASSERT_FALSE(removed);
    EXPECT_EQ(removed.error().cause, Cause::kCancelled);
    EXPECT_EQ(get_session(server.stub(), session).message.source().faces(), plate().face_count());
    EXPECT_TRUE(remove(server, all_under(session, 10)).status.ok()) << "the session is free again";
}

TEST(FeaturesRpcsTest, MemoryIsAskedForBeforeItIsTaken) {
    constexpr std::uint64_t kMoreThanReadingTakes = 200;  // bytes a face
    service::ServiceOptions options = small_server();
    options.limits.memory_bytes = kMoreThanReadingTakes * plate().face_count();
    TestServer server(options);
    const auto removed = remove(server, all_under(session_with(server.stub(), plate()), 10));
    EXPECT_TRUE(failed_with(removed.status, Cause::kLimitExceeded));
    EXPECT_THAT(removed.status.error_message(), HasSubstr("max_memory_bytes"));
}

TEST(FeaturesRpcsTest, SessionsWithoutAMeshOrWithAnOpenOne) {
    TestServer server;
    EXPECT_EQ(list(server, "none").status.error_code(), grpc::StatusCode::NOT_FOUND);
    const auto empty = create_session(server.stub());
    EXPECT_FALSE(list(server, empty.message.id()).status.ok());
    EXPECT_THAT(list(server, empty.message.id()).status.error_message(), HasSubstr("no mesh"));
    const std::string open = session_with(server.stub(), square(4));
    EXPECT_THAT(remove(server, all_under(open, 1)).status.error_message(), HasSubstr("the mesh is open"));
}

}  // namespace
}  // namespace vsplit::test

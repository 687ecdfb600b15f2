#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <string>
#include <vector>

#include "test_client.h"
#include "test_server.h"
#include "tests/core/meshes.h"

namespace vsplit::test {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

double seconds_between(const google::protobuf::Timestamp& from, const google::protobuf::Timestamp& to) {
    return static_cast<double>(to.seconds() - from.seconds()) + (to.nanos() - from.nanos()) * 1e-9;
}

TEST(CreateSessionTest, MakesAnEmptySession) {
    TestServer server;
    const Reply<v1::Session> created = create_session(server.stub());
    ASSERT_TRUE(created.status.ok()) << created.status.error_message();
    EXPECT_FALSE(created.message.id().empty());
    EXPECT_FALSE(created.message.has_source());
    EXPECT_EQ(created.message.representations_size(), 0);
    EXPECT_NEAR(seconds_between(created.message.create_time(), created.message.expire_time()), 3600, 5);
    EXPECT_THAT(server.finished(), Contains("CreateSession OK"));
}

TEST(CreateSessionTest, SummarisesTheMeshItIsGiven) {
    TestServer server;
    for (const MeshFormat format : {MeshFormat::kStlBinary, MeshFormat::kObj, MeshFormat::kPlyAscii, MeshFormat::kOff}) {
        const Reply<v1::Session> created = create_session(server.stub(), file_of(torus(12, 8), format));
        ASSERT_TRUE(created.status.ok()) << created.status.error_message();
        const v1::MeshSummary& source = created.message.source();
        EXPECT_EQ(source.faces(), 192U);
        EXPECT_EQ(source.vertices(), 96U);
        EXPECT_TRUE(source.closed());
        EXPECT_EQ(source.genus(), 1);
        EXPECT_EQ(source.components(), 1U);
        EXPECT_GT(source.bounding_box().max().x(), 1.3);
        EXPECT_EQ(source.quality().faces(), 192U);
        EXPECT_GT(source.quality().stretch_mean(), 0.2);
    }
}

TEST(CreateSessionTest, WeldsWithinTheTolerance) {
    TestServer server;
    const TriangleMesh two = joined(cube(), cube(), Vec3(1.001, 0, 0));
    const Reply<v1::Session> apart = create_session(server.stub(), file_of(two));
    const Reply<v1::Session> welded = create_session(server.stub(), file_of(two), 0.01);
    ASSERT_TRUE(apart.status.ok() && welded.status.ok());
    EXPECT_EQ(apart.message.source().vertices(), 16U);
    EXPECT_EQ(welded.message.source().vertices(), 12U);
}

TEST(CreateSessionTest, AnOpenMeshIsAcceptedAndItsSummarySaysSo) {
    TestServer server;
    TriangleMesh open = cube();
    open.faces.pop_back();
    const Reply<v1::Session> created = create_session(server.stub(), file_of(open));
    ASSERT_TRUE(created.status.ok()) << created.status.error_message();
    EXPECT_FALSE(created.message.source().closed());
    EXPECT_EQ(created.message.source().boundary_edges(), 3U);
    ASSERT_GE(created.message.source().findings_size(), 1);
    EXPECT_EQ(created.message.source().findings(0).kind(), "BOUNDARY_EDGE");
}

TEST(CreateSessionTest, RepairsWhatItIsAskedTo) {
    TestServer server;
    TriangleMesh open = test::icosphere(4);
    open.faces.pop_back();
    v1::CreateSessionRequest request;
    request.set_mesh(file_of(open));
    v1::Session session;
    for (const bool full : {false, true}) {
        request.set_repair(full ? v1::FULL : v1::SAFE);
        ASSERT_TRUE(server.stub().CreateSession(call().get(), request, &session).ok());
        EXPECT_EQ(session.source().closed(), full);
        ASSERT_EQ(session.source().findings_size(), 1);
        EXPECT_EQ(session.source().findings(0).kind(), full ? "FILLED_HOLE" : "BOUNDARY_EDGE");
        EXPECT_GE(session.source().findings(0).places_size(), 1);
    }
    request.set_hole_size(1e-3);  // of the hole 0.5
    ASSERT_TRUE(server.stub().CreateSession(call().get(), request, &session).ok());
    EXPECT_FALSE(session.source().closed());
    request.set_hole_size(-1);
    EXPECT_TRUE(failed_with(server.stub().CreateSession(call().get(), request, &session), Cause::kInvalidOption, "hole_size"));
    request.clear_hole_size();
    for (const v1::Repair repair : {v1::REPAIR_UNSPECIFIED, v1::SAFE}) {
        request.set_repair(repair);
        request.set_stitch(0.1);
        EXPECT_TRUE(failed_with(server.stub().CreateSession(call().get(), request, &session), Cause::kInvalidOption, "stitch"));
    }
    request.clear_stitch();
    request.set_repair(static_cast<v1::Repair>(9));
    EXPECT_TRUE(failed_with(server.stub().CreateSession(call().get(), request, &session), Cause::kInvalidOption, "repair"));
}

TEST(CreateSessionTest, BytesThatAreNoTextDoNotHarm) {
    TestServer server;
    const std::string vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    const Reply<v1::Session> group = create_session(server.stub(), vertices + "g \xff\x80wall\nf 1 2 3\n");
    ASSERT_TRUE(group.status.ok()) << group.status.error_message();
    ASSERT_EQ(group.message.source().groups_size(), 1);
    EXPECT_EQ(group.message.source().groups(0).name(), "??wall");
    // A set that no face is in, told of in a finding.
    const Reply<v1::Session> unused = create_session(
        server.stub(), "$HMNAME COMP 7\"\xff\"\nGRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,0.,1.,0.\nCTRIA3,2,3,1,2,3\n");
    ASSERT_TRUE(unused.status.ok()) << unused.status.error_message();
    EXPECT_NE(unused.message.source().findings(1).message().find("\\xff"), std::string::npos);
    for (const std::string& text : {vertices + "v 0 0 \xff\xfe\n", vertices + "\xc3\x28 1\n", vertices + "f 1 2 \xff\n",
                                    std::string("*NODE, SYSTEM=\xff\n"), std::string("GRID,1,,0.,0.,0.\nCTRI\xff,1,1,1,2,3\n"),
                                    std::string("<?xml version=\"1.0\"?>\n<VTKFile type=\"\xff\">\n</VTKFile>\n")}) {
        const Reply<v1::Session> broken = create_session(server.stub(), text);
        EXPECT_FALSE(broken.status.ok()) << text;
        EXPECT_NE(broken.status.error_code(), grpc::StatusCode::INTERNAL) << text;
        EXPECT_NE(broken.status.error_code(), grpc::StatusCode::UNKNOWN) << text;
        EXPECT_FALSE(broken.status.error_message().empty());
    }
}

TEST(CreateSessionTest, NamesTheLimitOfSessions) {
    service::ServiceOptions options = small_server();
    options.limits.sessions = 2;
    TestServer server(options);
    ASSERT_TRUE(create_session(server.stub()).status.ok());
    const Reply<v1::Session> second = create_session(server.stub(), file_of(cube()));
    ASSERT_TRUE(second.status.ok());
    const Reply<v1::Session> third = create_session(server.stub());
    EXPECT_TRUE(failed_with(third.status, Cause::kLimitExceeded));
    EXPECT_THAT(third.status.error_message(), HasSubstr("max_sessions"));
    EXPECT_TRUE(failed_with(create_session(server.stub(), file_of(cube())).status, Cause::kLimitExceeded));
    ASSERT_TRUE(delete_session(server.stub(), second.message.id()).ok());
    EXPECT_TRUE(create_session(server.stub()).status.ok());
}

TEST(GetSessionTest, ShowsTheMeshAndItsRepresentations) {
    TestServer server;
    const std::string id = session_with(server.stub(), icosphere(2));
    ASSERT_TRUE(improve(server.stub(), small_improve(id)).status.ok());
    const Reply<v1::Session> session = get_session(server.stub(), id);
    ASSERT_TRUE(session.status.ok());
    EXPECT_EQ(session.message.id(), id);
    EXPECT_EQ(session.message.source().faces(), 320U);
    ASSERT_EQ(session.message.representations_size(), 1);
    EXPECT_EQ(session.message.representations(0).id(), "r1");
}

TEST(DownloadMeshTest, ElementsAreOfTheOrderAskedFor) {
    TestServer server;
    const TriangleMesh mesh = icosphere(1);  // 42 vertices, 120 edges
    v1::DownloadMeshRequest request;
    request.set_session(session_with(server.stub(), mesh));
    request.set_format(v1::INP);
    const std::string as_is = download(server.stub(), request).file;
    request.set_order(1);
    EXPECT_EQ(download(server.stub(), request).file, as_is);
    EXPECT_THAT(as_is, HasSubstr("TYPE=S3"));
    EXPECT_THAT(as_is, Not(HasSubstr("\n162, ")));
    request.set_order(2);
    const std::string second = download(server.stub(), request).file;
    EXPECT_THAT(second, HasSubstr("TYPE=S6"));
    EXPECT_THAT(second, HasSubstr("\n162, "));
    EXPECT_THAT(second, Not(HasSubstr("\n163, ")));
    request.set_order(3);
    EXPECT_TRUE(failed_with(download(server.stub(), request).status, Cause::kInvalidOption, "order"));
    request.set_order(2);
    request.set_format(v1::STL);
    EXPECT_TRUE(failed_with(download(server.stub(), request).status, Cause::kUnsupported, "order"));
}

TEST(ListSessionsTest, PagesInOrderOfCreation) {
    TestServer server;
    std::vector<std::string> created(5);
    for (std::string& id : created) id = create_session(server.stub()).message.id();
    std::vector<std::string> listed;
    std::string token;
    do {
        const Reply<v1::ListSessionsResponse> page = list_sessions(server.stub(), 2, token);
        ASSERT_TRUE(page.status.ok());
        ASSERT_LE(page.message.sessions_size(), 2);
        for (const v1::Session& session : page.message.sessions()) listed.push_back(session.id());
        token = page.message.next_page_token();
    } while (!token.empty());
    EXPECT_EQ(listed, created);
    EXPECT_TRUE(failed_with(list_sessions(server.stub(), 2, "nonsense").status, Cause::kInvalidOption, "page_token"));
}

TEST(DeleteSessionTest, ForgetsTheSession) {
    TestServer server;
    const std::string id = session_with(server.stub(), cube());
    EXPECT_TRUE(delete_session(server.stub(), id).ok());
    EXPECT_TRUE(failed_with(get_session(server.stub(), id).status, Cause::kNotFound, "session"));
    EXPECT_TRUE(failed_with(delete_session(server.stub(), id), Cause::kNotFound, "session"));
}

TEST(SessionExpiryTest, AnUnusedSessionGoesAndAUsedOneStays) {
    service::ServiceOptions options = small_server();
    options.session_ttl = std::chrono::milliseconds(600);
    TestServer server(options);
    const std::string unused = session_with(server.stub(), cube());
    const std::string used = session_with(server.stub(), cube());
    const bool gone = eventually([&] {
        EXPECT_TRUE(get_session(server.stub(), used).status.ok());
        return list_sessions(server.stub()).message.sessions_size() == 1;
    });
    EXPECT_TRUE(gone) << "looking at the list is no use of a session";
    EXPECT_TRUE(failed_with(get_session(server.stub(), unused).status, Cause::kNotFound, "session"));
}

TEST(SessionExpiryTest, EveryUseMovesTheTime) {
    TestServer server;
    const std::string id = session_with(server.stub(), cube());
    const google::protobuf::Timestamp before = get_session(server.stub(), id).message.expire_time();
    ASSERT_TRUE(get_quality(server.stub(), id).status.ok());
    EXPECT_GT(seconds_between(before, get_session(server.stub(), id).message.expire_time()), 0);
}

}  // namespace
}  // namespace vsplit::test

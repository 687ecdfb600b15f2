#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "test_client.h"
#include "test_server.h"
#include "tests/core/meshes.h"
#include "vsplit/method/control.h"
#include "vsplit/method/improve.h"
#include "wire/convert.h"
#include "wire/representation.h"

namespace vsplit::test {
namespace {

using ::testing::HasSubstr;

class MethodRpcsTest : public ::testing::Test {
protected:
    v1::ControlRequest small_control(const std::string& session) const {
        v1::ControlRequest request;
        request.set_session(session);
        request.mutable_options()->set_subdivisions(1);
        request.mutable_options()->set_tolerance(0.05);
        request.mutable_options()->set_max_valence(10);
        return request;
    }

    // The stream rebuilt what the server would download at the same resolution.
    void expect_rebuilt(const Received& received, const std::string& session) {
        ASSERT_TRUE(received.status.ok()) << received.status.error_message();
        ASSERT_TRUE(received.representation && received.mesh);
        const v1::Representation& made = *received.representation;
        EXPECT_EQ(received.mesh->mesh().face_count(), made.faces());
        EXPECT_EQ(file_of(received.mesh->mesh()), download(server_.stub(), session, made.id()).file);
    }

    TestServer server_;
    const TriangleMesh mesh_ = bumpy_sphere(2, 0.05, 7);
    const std::string session_ = session_with(server_.stub(), mesh_);
};

TEST_F(MethodRpcsTest, ImproveStreamsProgressTheMeshAndTheRepresentation) {
    const Received received = improve(server_.stub(), small_improve(session_));
    expect_rebuilt(received, session_);
    ASSERT_FALSE(received.progress.empty());
    EXPECT_EQ(received.progress.front().stage(), "queued");
    EXPECT_EQ(received.representation->id(), "r1");
    EXPECT_EQ(received.representation->method(), v1::IMPROVE);
    EXPECT_EQ(received.representation->mode(), v1::EXTENDED);
    EXPECT_TRUE(received.representation->bounds_satisfied());
    EXPECT_EQ(received.representation->source().faces(), mesh_.face_count());
    EXPECT_EQ(received.representation->source().representation(), "");
    EXPECT_EQ(received.representation->quality().faces(), received.representation->faces());
    EXPECT_GT(received.base_parts, 0U);
}

TEST_F(MethodRpcsTest, AnOpenMeshIsStreamedAsItWouldBeDownloaded) {
    const TriangleMesh open = holed_square(8, 2);
    const std::string session = session_with(server_.stub(), open);
    for (const bool frozen : {false, true}) {
        v1::ImproveRequest request = small_improve(session);
        request.mutable_options()->set_freeze_boundary(frozen);
        const Received received = improve(server_.stub(), request);
        ASSERT_TRUE(received.status.ok()) << received.status.error_message();
        ASSERT_TRUE(received.representation && received.mesh);
        const v1::Representation& made = *received.representation;
        const TriangleMesh rebuilt = received.mesh->visible();
        EXPECT_EQ(received.mesh->ghosts(), 3U);
        EXPECT_EQ(rebuilt.face_count(), made.faces());
        EXPECT_EQ(file_of(rebuilt), download(server_.stub(), session, made.id()).file);
        EXPECT_EQ(made.improve_options().freeze_boundary(), frozen);
        v1::SetResolutionRequest coarser;
        coarser.set_session(session);
        coarser.set_representation(made.id());
        coarser.set_faces(made.faces_min());
        const Received base = set_resolution(server_.stub(), coarser);
        ASSERT_TRUE(base.status.ok() && base.mesh);
        EXPECT_EQ(file_of(base.mesh->visible()), download(server_.stub(), session, made.id(), made.faces_min()).file);
    }
    v1::ControlRequest request;
    request.set_session(session);
    request.mutable_source()->set_representation("r1");
    const Received controlled = control(server_.stub(), request);
    ASSERT_TRUE(controlled.status.ok()) << controlled.status.error_message();
    EXPECT_EQ(file_of(controlled.mesh->visible()), download(server_.stub(), session, controlled.representation->id()).file);
}

TEST_F(MethodRpcsTest, ImproveIsTheEnginesOwn) {
    const v1::ImproveRequest request = small_improve(session_);
    const Received received = improve(server_.stub(), request);
    ASSERT_TRUE(received.status.ok());
    const ImproveOptions options = *wire::from_proto(request.options());
    const Expected<MethodResult> own = vsplit::improve(mesh_, options, {}, ExecutionContext(nullptr, 1));
    ASSERT_TRUE(own) << own.error().message;
    v1::Representation expected = wire::describe("r1", "", mesh_.face_count(), *own, extent_of(own->mrr));
    *expected.mutable_elapsed() = received.representation->elapsed();  // the one thing that differs
    EXPECT_EQ(received.representation->DebugString(), expected.DebugString());
    EXPECT_EQ(received.mesh->mesh(), mesh_at(own->mrr, own->mrr.level_for(own->faces)));
}

TEST_F(MethodRpcsTest, WithoutOptionsTheDefaultsAreUsedAndShown) {
    v1::ImproveRequest request;
    request.set_session(session_with(server_.stub(), cube()));
    const Received received = improve(server_.stub(), request);
    expect_rebuilt(received, request.session());
    const v1::ImproveOptions& used = received.representation->improve_options();
    EXPECT_GT(used.subdivision_size(), 0);
    EXPECT_NEAR(used.tolerance(), 1e-3 * std::sqrt(3.0), 1e-9);
    EXPECT_EQ(used.feature_angle(), 40);
    EXPECT_GT(used.faces(), 0U);
    EXPECT_NEAR(used.max_deviation(), 2e-3 * std::sqrt(3.0), 1e-9);
    EXPECT_TRUE(received.representation->quality().has_deviation_max());
}

TEST_F(MethodRpcsTest, ControlFromAnImprovedMeshAsInThePapersTable) {
    const Received improved = improve(server_.stub(), small_improve(session_));
    ASSERT_TRUE(improved.status.ok());
    v1::ControlRequest request = small_control(session_);
    request.mutable_source()->set_representation("r1");
    request.mutable_source()->set_faces(improved.representation->faces_max() + 1000);  // the nearest is the finest
    const Received controlled = control(server_.stub(), request);
    expect_rebuilt(controlled, session_);
    EXPECT_EQ(controlled.representation->id(), "r2");
    EXPECT_EQ(controlled.representation->method(), v1::CONTROL);
    EXPECT_EQ(controlled.representation->source().representation(), "r1");
    EXPECT_EQ(controlled.representation->source().faces(), improved.representation->faces_max());
    EXPECT_EQ(controlled.representation->faces_max(), 4 * improved.representation->faces_max());
    EXPECT_EQ(controlled.representation->control_options().min_stretch(), 0.2);
    EXPECT_EQ(get_session(server_.stub(), session_).message.representations_size(), 2);
}

TEST_F(MethodRpcsTest, ControlReportsBoundsThatCannotBeMet) {
    v1::ControlRequest request = small_control(session_);
    request.mutable_options()->set_min_stretch(0.999);
    const Received received = control(server_.stub(), request);
    expect_rebuilt(received, session_);
    EXPECT_FALSE(received.representation->bounds_satisfied());
    ASSERT_GE(received.representation->violations_size(), 1);
    const v1::Violation& violation = received.representation->violations(0);
    EXPECT_EQ(violation.bound(), "min_stretch");
    EXPECT_EQ(violation.limit(), 0.999);
    EXPECT_GT(violation.count(), 0U);
    EXPECT_FALSE(violation.reason().empty());
}

TEST_F(MethodRpcsTest, ProgressNamesTheStagesInOrderAndIsNoFlood) {
    v1::ImproveRequest request = small_improve(session_);
    request.mutable_options()->set_subdivision_size(0.03);
    const Received received = improve(server_.stub(), request);
    ASSERT_TRUE(received.status.ok());
    const double seconds = static_cast<double>(received.representation->elapsed().seconds()) + 1;
    EXPECT_LE(static_cast<double>(received.progress.size()), 30 * seconds);
    std::string stages;
    for (const v1::Progress& progress : received.progress) {
        if (!stages.ends_with(progress.stage() + ' ')) stages += progress.stage() + ' ';
    }
    const std::string all = "queued inspect subdivide evaluate simplify measure ";
    std::size_t at = 0;
    for (const v1::Progress& progress : received.progress) {
        const std::size_t found = all.find(progress.stage());
        ASSERT_NE(found, std::string::npos) << stages;
        EXPECT_GE(found, at) << stages;
        at = found;
    }
}

TEST_F(MethodRpcsTest, ASecondMethodOnASessionWaitsItsTurn) {
    const std::string id = session_with(server_.stub(), icosphere(3));
    RunningImprove running(server_.stub(), long_improve(id));
    ASSERT_TRUE(running.wait_until_working());
    RunningImprove waiting(server_.stub(), small_improve(id));
    ASSERT_TRUE(waiting.wait_until_queued());
    EXPECT_EQ(get_session(server_.stub(), id).message.representations_size(), 0);
    running.cancel();
    EXPECT_EQ(running.finish().error_code(), grpc::StatusCode::CANCELLED);
    EXPECT_TRUE(waiting.finish().ok());
    EXPECT_EQ(get_session(server_.stub(), id).message.representations_size(), 1);
}

TEST_F(MethodRpcsTest, NamesTheLimitOfWaitingRequests) {
    service::ServiceOptions options = small_server();
    options.limits.waiting_jobs = 1;
    TestServer server(options);
    const std::string id = session_with(server.stub(), icosphere(3));
    RunningImprove running(server.stub(), long_improve(id));
    ASSERT_TRUE(running.wait_until_working());
    RunningImprove waiting(server.stub(), long_improve(id));
    ASSERT_TRUE(waiting.wait_until_queued());
    const Received refused = improve(server.stub(), small_improve(id));
    EXPECT_TRUE(failed_with(refused.status, Cause::kLimitExceeded, "session"));
    EXPECT_THAT(refused.status.error_message(), HasSubstr("max_waiting"));
}

TEST_F(MethodRpcsTest, ABusySessionHoldsUpNoOther) {
    // Two workers: one for the method that runs. Those that wait behind it must leave the other one free.
    const std::string busy = session_with(server_.stub(), icosphere(3));
    RunningImprove running(server_.stub(), long_improve(busy));
    ASSERT_TRUE(running.wait_until_working());
    RunningImprove second(server_.stub(), long_improve(busy));
    RunningImprove third(server_.stub(), long_improve(busy));
    ASSERT_TRUE(second.wait_until_queued() && third.wait_until_queued());
    EXPECT_TRUE(improve(server_.stub(), small_improve(session_)).status.ok());
    EXPECT_EQ(get_session(server_.stub(), busy).message.representations_size(), 0) << "the busy session was still at work";
}

TEST_F(MethodRpcsTest, ReadersWaitForNoMethodEvenWhenAllWorkersAreTaken) {
    ASSERT_TRUE(improve(server_.stub(), small_improve(session_)).status.ok());
    const std::string one = session_with(server_.stub(), icosphere(3));
    const std::string two = session_with(server_.stub(), icosphere(3));
    RunningImprove first(server_.stub(), long_improve(one));
    RunningImprove second(server_.stub(), long_improve(two));
    ASSERT_TRUE(first.wait_until_working() && second.wait_until_working());
    EXPECT_TRUE(download(server_.stub(), session_, "r1").status.ok());
    EXPECT_TRUE(get_quality(server_.stub(), session_, "r1", 100).status.ok());
    EXPECT_TRUE(get_quality(server_.stub(), one).status.ok()) << "not even of the session that is at work";
    EXPECT_TRUE(upload(server_.stub(), session_, file_of(cube())).status.ok());
    EXPECT_EQ(get_session(server_.stub(), one).message.representations_size(), 0);
    EXPECT_EQ(get_session(server_.stub(), two).message.representations_size(), 0);
}

TEST_F(MethodRpcsTest, NamesTheLimitOfRepresentations) {
    service::ServiceOptions options = small_server();
    options.limits.representations = 1;
    TestServer server(options);
    const std::string id = session_with(server.stub(), mesh_);
    ASSERT_TRUE(improve(server.stub(), small_improve(id)).status.ok());
    v1::ImproveRequest other = small_improve(id);
    other.mutable_options()->set_feature_weight(3);
    const Received refused = improve(server.stub(), other);
    EXPECT_TRUE(failed_with(refused.status, Cause::kLimitExceeded, "session"));
    EXPECT_THAT(refused.status.error_message(), HasSubstr("max_representations"));
}

}  // namespace
}  // namespace vsplit::test

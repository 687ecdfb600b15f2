#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <thread>
#include <vector>

#include "test_client.h"
#include "test_server.h"
#include "tests/core/meshes.h"

namespace vsplit::test {
namespace {

using ::testing::HasSubstr;

class UploadRpcTest : public ::testing::Test {
protected:
    v1::UploadMeshRequest part(std::size_t offset, const std::string& data) const {
        v1::UploadMeshRequest request;
        request.set_offset(offset);
        request.set_data(data);
        return request;
    }

    v1::UploadMeshRequest first_part(const std::string& data) const {
        v1::UploadMeshRequest request = part(0, data);
        request.set_session(session_);
        return request;
    }

    // The mesh and the representation are what they were before the upload that failed.
    void expect_unharmed() {
        const Reply<v1::Session> session = get_session(server_.stub(), session_);
        ASSERT_TRUE(session.status.ok());
        EXPECT_EQ(session.message.source().faces(), 80U);
        EXPECT_EQ(session.message.representations_size(), 1);
        EXPECT_TRUE(download(server_.stub(), session_, "r1").status.ok());
        EXPECT_TRUE(upload(server_.stub(), create_session(server_.stub()).message.id(), file_).status.ok());
    }

    void make_representation() { ASSERT_TRUE(improve(server_.stub(), small_improve(session_)).status.ok()); }

    TestServer server_;
    const std::string session_ = session_with(server_.stub(), icosphere(1));
    const std::string file_ = file_of(torus(40, 20));
};

TEST_F(UploadRpcTest, ReplacesTheMeshAndDropsRepresentations) {
    make_representation();
    const Reply<v1::Session> uploaded = upload(server_.stub(), session_, file_, 777);
    ASSERT_TRUE(uploaded.status.ok()) << uploaded.status.error_message();
    EXPECT_EQ(uploaded.message.id(), session_);
    EXPECT_EQ(uploaded.message.source().faces(), 1600U);
    EXPECT_EQ(uploaded.message.representations_size(), 0);
    EXPECT_TRUE(failed_with(download(server_.stub(), session_, "r1").status, Cause::kNotFound, "representation"));
}

TEST(UploadStallTest, AnUploadThatSendsNothingEnds) {
    rpc::GrpcExtras extras;
    extras.patience.stall = std::chrono::milliseconds(300);
    TestServer server(small_server(), extras);
    const std::string session = create_session(server.stub()).message.id();
    v1::UploadMeshRequest part;
    part.set_session(session);
    for (const bool starts : {false, true}) {
        v1::Session response;
        const auto context = call();
        const auto writer = server.stub().UploadMesh(context.get(), &response);
        if (starts) {
            EXPECT_TRUE(writer->Write(part));
        }
        EXPECT_TRUE(failed_with(writer->Finish(), Cause::kUnavailable, "")) << starts;
    }
    EXPECT_TRUE(upload(server.stub(), session, file_of(torus(40, 20))).status.ok()) << "nothing is left of it";
}

TEST(UploadStallTest, AnUploadThatTricklesEnds) {
    rpc::GrpcExtras extras;
    extras.patience = {std::chrono::milliseconds(500), 1024};
    TestServer server(small_server(), extras);
    v1::UploadMeshRequest part;
    part.set_session(create_session(server.stub()).message.id());
    part.set_data("v");
    v1::Session response;
    const auto context = call();
    const auto writer = server.stub().UploadMesh(context.get(), &response);
    int parts = 0;
    for (; parts < 100 && writer->Write(part); ++parts) {
        part.set_offset(part.offset() + 1);
        std::this_thread::sleep_for(std::chrono::milliseconds(50));  // a tenth of what is waited for
    }
    EXPECT_LT(parts, 100);
    const grpc::Status status = writer->Finish();
    EXPECT_TRUE(failed_with(status, Cause::kUnavailable, ""));
    EXPECT_THAT(status.error_message(), HasSubstr("1024 bytes a second"));
}

TEST_F(UploadRpcTest, TheDownloadIsTheUploadExactly) {
    ASSERT_TRUE(upload(server_.stub(), session_, file_).status.ok());
    EXPECT_EQ(download(server_.stub(), session_).file, file_);
}

TEST_F(UploadRpcTest, TakesAFirstMessageWithoutDataAndRepeatedSettings) {
    v1::UploadMeshRequest settings = first_part("");
    settings.set_format(v1::PLY);
    settings.set_size(file_.size());
    v1::UploadMeshRequest again = settings;
    again.set_data(file_);
    EXPECT_TRUE(upload_parts(server_.stub(), {settings, again}).status.ok());
}

TEST_F(UploadRpcTest, RefusesSettingsThatChange) {
    make_representation();
    const v1::UploadMeshRequest first = first_part(file_.substr(0, 100));
    std::vector<std::pair<std::string, v1::UploadMeshRequest>> changes;
    for (const char* field : {"session", "format", "weld", "size", "stitch", "hole_size", "speck_size"})
        changes.emplace_back(field, part(100, file_.substr(100)));
    changes[0].second.set_session("another");
    changes[1].second.set_format(v1::STL);
    changes[2].second.set_weld(0.5);
    changes[3].second.set_size(file_.size());
    changes[4].second.set_stitch(0);
    changes[5].second.set_hole_size(1);
    changes[6].second.set_speck_size(1);
    for (const auto& [field, changed] : changes) {
        EXPECT_TRUE(failed_with(upload_parts(server_.stub(), {first, changed}).status, Cause::kInvalidOption, field));
    }
    expect_unharmed();
}

TEST_F(UploadRpcTest, NamesTheOffsetItExpected) {
    make_representation();
    const auto reply = upload_parts(server_.stub(), {first_part(file_.substr(0, 100)), part(200, file_.substr(200))});
    EXPECT_TRUE(failed_with(reply.status, Cause::kOutOfOrder, "offset"));
    EXPECT_THAT(reply.status.error_message(), HasSubstr("offset is 200, expected is 100"));
    expect_unharmed();
}

TEST_F(UploadRpcTest, AnUploadThatIsCutOffChangesNothing) {
    make_representation();
    v1::UploadMeshRequest first = first_part(file_.substr(0, 1000));
    first.set_size(file_.size());
    EXPECT_TRUE(failed_with(upload_parts(server_.stub(), {first}).status, Cause::kTruncatedInput, "size"));
    expect_unharmed();
}

TEST_F(UploadRpcTest, AClientThatGoesInMidStreamChangesNothing) {
    make_representation();
    const std::string text = file_of(torus(40, 20), MeshFormat::kObj);  // any of its beginnings could pass for a mesh
    for (int i = 0; i < 100; ++i) {
        const auto context = call();
        v1::Session response;
        const auto writer = server_.stub().UploadMesh(context.get(), &response);
        ASSERT_TRUE(writer->Write(first_part(text)));
        context->TryCancel();
        EXPECT_EQ(writer->Finish().error_code(), grpc::StatusCode::CANCELLED);
    }
    const auto ended = [this] {
        const std::vector<std::string> finished = server_.finished();
        return std::count_if(finished.begin(), finished.end(),
                             [](const std::string& f) { return f.starts_with("UploadMesh"); }) == 100;
    };
    EXPECT_TRUE(eventually(ended)) << "every upload ends";
    expect_unharmed();
}

TEST_F(UploadRpcTest, RefusesASizeOverTheLimitBeforeTheFirstByte) {
    make_representation();
    v1::UploadMeshRequest first = first_part("");
    first.set_size(std::uint64_t{1} << 40);
    const auto reply = upload_parts(server_.stub(), {first});
    EXPECT_TRUE(failed_with(reply.status, Cause::kLimitExceeded, "size"));
    EXPECT_THAT(reply.status.error_message(), HasSubstr("max_upload_bytes"));
    expect_unharmed();
}

TEST_F(UploadRpcTest, RefusesBytesOverTheLimitAsTheyCome) {
    service::ServiceOptions options = small_server();
    options.limits.upload_bytes = 10000;
    TestServer server(options);
    const std::string id = create_session(server.stub()).message.id();
    v1::UploadMeshRequest first = part(0, file_.substr(0, 6000));
    first.set_session(id);
    const auto reply = upload_parts(server.stub(), {first, part(6000, file_.substr(6000, 6000))});
    EXPECT_TRUE(failed_with(reply.status, Cause::kLimitExceeded, "data"));
    EXPECT_FALSE(get_session(server.stub(), id).message.has_source());
    const auto whole = create_session(server.stub(), file_);
    EXPECT_TRUE(failed_with(whole.status, Cause::kLimitExceeded, "mesh")) << "the other way has the same limit";
}

TEST_F(UploadRpcTest, IsBusyWhileAMethodRunsAndFreeAfterwards) {
    const std::string id = session_with(server_.stub(), icosphere(3));
    RunningImprove running(server_.stub(), long_improve(id));
    ASSERT_TRUE(running.wait_until_working());
    EXPECT_TRUE(failed_with(upload(server_.stub(), id, file_).status, Cause::kBusy, "session"));
    EXPECT_TRUE(get_session(server_.stub(), id).status.ok()) << "readers never wait";
    running.cancel();
    EXPECT_TRUE(eventually([&] { return upload(server_.stub(), id, file_).status.ok(); }));
}

TEST_F(UploadRpcTest, RefusesAnEmptyStreamAndAnUnknownSession) {
    EXPECT_TRUE(failed_with(upload_parts(server_.stub(), {}).status, Cause::kInvalidOption, "session"));
    EXPECT_TRUE(failed_with(upload(server_.stub(), "nobody", file_).status, Cause::kNotFound, "session"));
}

TEST_F(UploadRpcTest, RepairsWhatItIsAskedTo) {
    TriangleMesh open = test::icosphere(4);
    open.faces.pop_back();
    v1::UploadMeshRequest first = first_part(file_of(open));
    first.set_repair(v1::FULL);
    const auto uploaded = upload_parts(server_.stub(), {first});
    ASSERT_TRUE(uploaded.status.ok()) << uploaded.status.error_message();
    EXPECT_TRUE(uploaded.message.source().closed());
    first.set_hole_size(1e-3);
    EXPECT_FALSE(upload_parts(server_.stub(), {first}).message.source().closed());
    first.set_hole_size(std::nan(""));
    EXPECT_TRUE(failed_with(upload_parts(server_.stub(), {first}).status, Cause::kInvalidOption, "hole_size"));
    first.set_repair(static_cast<v1::Repair>(9));
    EXPECT_TRUE(failed_with(upload_parts(server_.stub(), {first}).status, Cause::kInvalidOption, "repair"));
}

}  // namespace
}  // namespace vsplit::test

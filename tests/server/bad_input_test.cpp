// Whatever comes in: a clear error with its cause, and a server and a session that are as they were.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <functional>
#include <limits>
#include <ostream>
#include <string>
#include <vector>

#include "test_client.h"
#include "test_server.h"
#include "tests/core/meshes.h"

namespace vsplit::test {
namespace {

using ::testing::HasSubstr;

struct BadFile {
    std::string name;
    std::string bytes;
    std::vector<Cause> causes;  // any of these is a clear answer
};

// How a test names the file it fails on.
std::ostream& operator<<(std::ostream& out, const BadFile& file) { return out << file.name; }

std::string obj(const std::string& lines) { return "v 0 0 0\nv 1 0 0\nv 0 1 0\n" + lines; }

// A binary STL whose header announces `faces` and which has the bytes of one.
std::string lying_stl(std::uint32_t faces) {
    std::string file(80 + 4 + 50, '\0');
    std::memcpy(file.data() + 80, &faces, sizeof faces);
    return file;
}

std::string stl_with(float coordinate) {
    std::string file = lying_stl(1);
    std::memcpy(file.data() + 84 + 12, &coordinate, sizeof coordinate);
    return file;
}

std::vector<BadFile> bad_files() {
    const std::string good = file_of(torus(10, 8));
    return {
        {"Empty", "", {Cause::kEmptyInput}},
        {"TruncatedPly", good.substr(0, good.size() - 5), {Cause::kTruncatedInput}},
        {"TruncatedStl", file_of(cube(), MeshFormat::kStlBinary).substr(0, 300), {Cause::kTruncatedInput, Cause::kUnknownFormat}},
        {"Garbage", std::string(5000, '\xfe'), {Cause::kUnknownFormat, Cause::kTruncatedInput, Cause::kMalformedInput}},
        {"GarbageText", "this is not a mesh at all\n", {Cause::kUnknownFormat}},
        {"FourBillionFaces", lying_stl(4'294'967'295U), {Cause::kTruncatedInput, Cause::kLimitExceeded, Cause::kUnknownFormat}},
        {"FourBillionVertices",
         "ply\nformat binary_little_endian 1.0\nelement vertex 4294967295\nproperty double x\nproperty double y\nproperty double "
         "z\n"
         "element face 1\nproperty list uchar uint vertex_indices\nend_header\n",
         {Cause::kTruncatedInput, Cause::kLimitExceeded}},
        {"NotANumber", stl_with(std::nanf("")), {Cause::kInvalidCoordinate}},
        {"Infinite", stl_with(std::numeric_limits<float>::infinity()), {Cause::kInvalidCoordinate}},
        {"TextNotANumber", obj("v nan 0 0\nf 1 2 3\n"), {Cause::kInvalidCoordinate, Cause::kMalformedInput}},
        {"IndexOutOfRange", obj("f 1 2 4\n"), {Cause::kIndexOutOfRange}},
        {"BrokenNumber", obj("v 1 2 three\nf 1 2 3\n"), {Cause::kMalformedInput}},
    };
}

class BadFileTest : public ::testing::TestWithParam<BadFile> {
protected:
    void expect_clear(const grpc::Status& status) const {
        const auto is_cause = [&](Cause cause) { return static_cast<bool>(failed_with(status, cause)); };
        EXPECT_TRUE(std::any_of(GetParam().causes.begin(), GetParam().causes.end(), is_cause))
            << failed_with(status, GetParam().causes.front()).message();
        EXPECT_GT(status.error_message().size(), 20U) << "it says what was wrong and what would do";
    }

    TestServer server_;
};

TEST_P(BadFileTest, AnUploadLeavesServerAndSessionUnharmed) {
    const std::string session = session_with(server_.stub(), cube());
    expect_clear(upload(server_.stub(), session, GetParam().bytes).status);
    EXPECT_EQ(get_session(server_.stub(), session).message.source().faces(), 12U);
    EXPECT_TRUE(upload(server_.stub(), session, file_of(torus(10, 8))).status.ok());
    EXPECT_TRUE(improve(server_.stub(), small_improve(session)).status.ok());
}

class BadMeshTest : public BadFileTest {};

TEST_P(BadMeshTest, ACreateMakesNoSession) {
    expect_clear(create_session(server_.stub(), GetParam().bytes).status);
    EXPECT_EQ(list_sessions(server_.stub()).message.sessions_size(), 0);
    EXPECT_TRUE(create_session(server_.stub(), file_of(cube())).status.ok());
}

std::string name_of(const ::testing::TestParamInfo<BadFile>& tested) { return tested.param.name; }

INSTANTIATE_TEST_SUITE_P(All, BadFileTest, ::testing::ValuesIn(bad_files()), name_of);

// Without the first, the empty one: a create without bytes asks for a session without a mesh.
std::vector<BadFile> bad_meshes() {
    std::vector<BadFile> files = bad_files();
    files.erase(files.begin());
    return files;
}

INSTANTIATE_TEST_SUITE_P(All, BadMeshTest, ::testing::ValuesIn(bad_meshes()), name_of);

class BadRequestTest : public ::testing::Test {
protected:
    // The session works as if nothing had been asked.
    void expect_unharmed() {
        EXPECT_EQ(get_session(server_.stub(), session_).message.representations_size(), 0);
        EXPECT_TRUE(improve(server_.stub(), small_improve(session_)).status.ok());
    }

    TestServer server_;
    const std::string session_ = session_with(server_.stub(), icosphere(2));
};

TEST_F(BadRequestTest, MethodsRefuseABoundaryThatTouchesItselfNamingWhere) {
    TriangleMesh touching = square(2);
    touching.faces = {{0, 1, 4}, {0, 4, 3}, {4, 5, 8}, {4, 8, 7}};
    const std::string id = session_with(server_.stub(), touching);
    const Received improved = improve(server_.stub(), small_improve(id));
    EXPECT_TRUE(failed_with(improved.status, Cause::kNonManifold));
    EXPECT_THAT(improved.status.error_message(), HasSubstr("touches itself at vertex"));
    v1::ControlRequest request;
    request.set_session(id);
    EXPECT_TRUE(failed_with(control(server_.stub(), request).status, Cause::kNonManifold));
    EXPECT_TRUE(download(server_.stub(), id).status.ok()) << "it can still be looked at";
    expect_unharmed();
}

TEST_F(BadRequestTest, MethodsRefuseANonManifoldMesh) {
    TriangleMesh fins = cube();
    fins.positions.emplace_back(0.5, -1, 0.5);
    fins.faces.push_back({fins.faces[0][0], fins.faces[0][1], 8});
    const std::string id = session_with(server_.stub(), fins);
    EXPECT_TRUE(failed_with(improve(server_.stub(), small_improve(id)).status, Cause::kNonManifold));
    expect_unharmed();
}

TEST_F(BadRequestTest, EveryRpcNamesAnUnknownSession) {
    Stub& stub = server_.stub();
    const std::string id = "0123456789abcdef";
    v1::ControlRequest control_request;
    control_request.set_session(id);
    v1::SetResolutionRequest resolution_request;
    resolution_request.set_session(id);
    const std::vector<grpc::Status> answers{
        get_session(stub, id).status,
        delete_session(stub, id),
        upload(stub, id, "x").status,
        improve(stub, small_improve(id)).status,
        control(stub, control_request).status,
        set_resolution(stub, resolution_request).status,
        download(stub, id).status,
        get_quality(stub, id).status,
    };
    for (const grpc::Status& status : answers) {
        EXPECT_TRUE(failed_with(status, Cause::kNotFound, "session"));
        EXPECT_EQ(status.error_code(), grpc::StatusCode::NOT_FOUND);
        EXPECT_THAT(status.error_message(), HasSubstr(id));
    }
    expect_unharmed();
}

TEST_F(BadRequestTest, ImproveNamesTheOptionAtFault) {
    using Spoil = std::function<void(v1::ImproveOptions&)>;
    const std::vector<std::pair<std::string, Spoil>> cases{
        {"subdivision_size", [](v1::ImproveOptions& o) { o.set_subdivision_size(0); }},
        {"subdivision_size", [](v1::ImproveOptions& o) { o.set_subdivision_size(std::nan("")); }},
        {"tolerance", [](v1::ImproveOptions& o) { o.set_tolerance(-1); }},
        {"tolerance", [](v1::ImproveOptions& o) { o.set_tolerance(HUGE_VAL); }},
        {"feature_angle", [](v1::ImproveOptions& o) { o.set_feature_angle(181); }},
        {"feature_weight", [](v1::ImproveOptions& o) { o.set_feature_weight(-0.5); }},
        {"mode", [](v1::ImproveOptions& o) { o.set_mode(static_cast<v1::Mode>(7)); }},
    };
    for (const auto& [field, spoil] : cases) {
        v1::ImproveRequest request = small_improve(session_);
        spoil(*request.mutable_options());
        const Received received = improve(server_.stub(), request);
        EXPECT_TRUE(failed_with(received.status, Cause::kInvalidOption, field)) << field;
        EXPECT_TRUE(received.progress.empty()) << "told at once, not after waiting";
    }
    v1::ImproveRequest contradictory = small_improve(session_);
    contradictory.mutable_options()->set_faces(100);
    contradictory.mutable_options()->set_faces_min(200);
    EXPECT_EQ(improve(server_.stub(), contradictory).status.error_code(), grpc::StatusCode::INVALID_ARGUMENT);
    expect_unharmed();
}

TEST_F(BadRequestTest, ControlNamesTheOptionAtFault) {
    using Spoil = std::function<void(v1::ControlOptions&)>;
    const std::vector<std::pair<std::string, Spoil>> cases{
        {"subdivisions", [](v1::ControlOptions& o) { o.set_subdivisions(13); }},
        {"min_stretch", [](v1::ControlOptions& o) { o.set_min_stretch(1.5); }},
        {"max_size", [](v1::ControlOptions& o) { o.set_max_size(0); }},
        {"max_valence", [](v1::ControlOptions& o) { o.set_max_valence(5); }},
    };
    for (const auto& [field, spoil] : cases) {
        v1::ControlRequest request;
        request.set_session(session_);
        spoil(*request.mutable_options());
        EXPECT_TRUE(failed_with(control(server_.stub(), request).status, Cause::kInvalidOption, field)) << field;
    }
    expect_unharmed();
}

TEST_F(BadRequestTest, WhatTheStrictModeLacksIsUnsupported) {
    v1::ImproveRequest bounded = small_improve(session_);
    bounded.mutable_options()->set_mode(v1::STRICT);
    bounded.mutable_options()->set_max_deviation(0.1);
    EXPECT_TRUE(failed_with(improve(server_.stub(), bounded).status, Cause::kUnsupported, "max_deviation"));
    expect_unharmed();
}

TEST_F(BadRequestTest, ASubdivisionOverTheLimitNamesAValueThatFits) {
    service::ServiceOptions options = small_server();
    options.limits.faces_subdivided = 20000;
    TestServer server(options);
    v1::ImproveRequest request = small_improve(session_with(server.stub(), icosphere(2)));
    request.mutable_options()->set_subdivision_size(1e-6);
    const Received refused = improve(server.stub(), request);
    ASSERT_TRUE(failed_with(refused.status, Cause::kLimitExceeded, "subdivision_size"));
    // The number that the message names is taken at its word.
    const std::string& message = refused.status.error_message();
    bool fits = false;
    for (std::size_t at = message.find_first_of("0123456789"); at != std::string::npos && !fits;) {
        std::size_t length = 0;
        const double value = std::stod(message.substr(at), &length);
        if (value > 1e-5 && value < 1) {
            request.mutable_options()->set_subdivision_size(value);
            fits = improve(server.stub(), request).status.ok();
        }
        at = message.find_first_of("0123456789", at + length);
    }
    EXPECT_TRUE(fits) << message;
    v1::ControlRequest control_request;
    control_request.set_session(request.session());
    control_request.mutable_options()->set_subdivisions(12);
    EXPECT_TRUE(failed_with(control(server.stub(), control_request).status, Cause::kLimitExceeded, "subdivisions"));
}

TEST_F(BadRequestTest, AnUnknownSourceIsNamed) {
    v1::ImproveRequest request = small_improve(session_);
    request.mutable_source()->set_representation("r9");
    EXPECT_TRUE(failed_with(improve(server_.stub(), request).status, Cause::kNotFound, "representation"));
    EXPECT_TRUE(failed_with(download(server_.stub(), session_, "r9").status, Cause::kNotFound, "representation"));
    EXPECT_TRUE(failed_with(get_quality(server_.stub(), session_, "r9").status, Cause::kNotFound, "representation"));
    expect_unharmed();
}

TEST_F(BadRequestTest, AMessageOverTheLimitIsRefused) {
    const Reply<v1::Session> reply = create_session(server_.stub(), std::string(rpc::GrpcLimits().message_bytes + 1, 'x'));
    EXPECT_EQ(reply.status.error_code(), grpc::StatusCode::RESOURCE_EXHAUSTED);
    expect_unharmed();
}

}  // namespace
}  // namespace vsplit::test

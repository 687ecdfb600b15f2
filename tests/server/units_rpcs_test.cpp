// Units of length over the wire: from the file or the upload, with every answer that has lengths, and converted in downloads.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "test_client.h"
#include "test_server.h"
#include "tests/core/drilled_plate.h"
#include "tests/core/meshes.h"
#include "vsplit/io/read_mesh.h"
#include "vsplit/io/write_mesh.h"

namespace vsplit::test {
namespace {

using ::testing::HasSubstr;

Reply<v1::Session> create(TestServer& server, const std::string& file, v1::LengthUnit unit) {
    v1::CreateSessionRequest request;
    request.set_mesh(file);
    request.set_unit(unit);
    Reply<v1::Session> reply;
    reply.status = server.stub().CreateSession(call().get(), request, &reply.message);
    return reply;
}

v1::DownloadMeshRequest download_in(const std::string& session, v1::LengthUnit unit, v1::MeshFormat format = v1::PLY) {
    v1::DownloadMeshRequest request;
    request.set_session(session);
    request.set_format(format);
    request.set_unit(unit);
    return request;
}

ReadResult read(const std::string& file) {
    Expected<ReadResult> result = read_mesh(std::as_bytes(std::span(file)), {});
    EXPECT_TRUE(result) << result.error().message;
    return result ? *std::move(result) : ReadResult();
}

TEST(UnitsRpcsTest, TheFileOrTheUploadSaysIt) {
    TestServer server;
    EXPECT_EQ(create_session(server.stub(), file_of(cube())).message.source().unit(), v1::LENGTH_UNIT_UNSPECIFIED);
    EXPECT_EQ(create(server, file_of(cube()), v1::INCH).message.source().unit(), v1::INCH);
    const std::string told = write_mesh(cube(), MeshFormat::k3mf, LengthUnit::kFoot);
    EXPECT_EQ(create(server, told, v1::LENGTH_UNIT_UNSPECIFIED).message.source().unit(), v1::FOOT);
    const Reply<v1::Session> contrary = create(server, told, v1::METRE);
    EXPECT_TRUE(failed_with(contrary.status, Cause::kInvalidOption, "unit"));
    EXPECT_THAT(contrary.status.error_message(), HasSubstr("in ft, and m is stated"));
    EXPECT_TRUE(failed_with(create(server, told, static_cast<v1::LengthUnit>(99)).status, Cause::kInvalidOption, "unit"));
}

TEST(UnitsRpcsTest, AnUploadStatesItInItsFirstMessage) {
    TestServer server;
    const std::string file = file_of(cube());
    v1::UploadMeshRequest first;
    first.set_session(create_session(server.stub()).message.id());
    first.set_data(file.substr(0, 100));
    first.set_unit(v1::CENTIMETRE);
    v1::UploadMeshRequest second;
    second.set_offset(100);
    second.set_data(file.substr(100));
    EXPECT_EQ(upload_parts(server.stub(), {first, second}).message.source().unit(), v1::CENTIMETRE);
    second.set_unit(v1::METRE);
    EXPECT_TRUE(failed_with(upload_parts(server.stub(), {first, second}).status, Cause::kInvalidOption, "unit"));
    EXPECT_EQ(get_session(server.stub(), first.session()).message.source().unit(), v1::CENTIMETRE);
    EXPECT_EQ(get_session(server.stub(), first.session()).message.source().quality().unit(), v1::CENTIMETRE);
}

TEST(UnitsRpcsTest, WhateverHasLengthsSaysTheirUnit) {
    TestServer server;
    const std::string session = create(server, file_of(icosphere(2)), v1::MILLIMETRE).message.id();
    const Received made = improve(server.stub(), small_improve(session));
    ASSERT_TRUE(made.status.ok());
    EXPECT_EQ(made.representation->unit(), v1::MILLIMETRE);
    EXPECT_EQ(made.representation->quality().unit(), v1::MILLIMETRE);
    v1::SetResolutionRequest coarser;
    coarser.set_session(session);
    coarser.set_faces(100);
    const Received resolution = set_resolution(server.stub(), coarser);
    EXPECT_EQ(resolution.representation->unit(), v1::MILLIMETRE);
    EXPECT_EQ(resolution.representation->quality().unit(), v1::MILLIMETRE);
    EXPECT_EQ(get_session(server.stub(), session).message.representations(0).unit(), v1::MILLIMETRE);
    for (const char* representation : {"", "r1"})
        EXPECT_EQ(get_quality(server.stub(), session, representation).message.unit(), v1::MILLIMETRE);
}

TEST(UnitsRpcsTest, FeaturesKeepTheUnit) {
    TestServer server;
    const TriangleMesh plate = drilled_plate(2, 10, 4, {{4, 4, 24}, {3, 2, 24}});
    const std::string session = create(server, file_of(plate), v1::INCH).message.id();
    v1::ListFeaturesRequest list;
    list.set_session(session);
    v1::ListFeaturesResponse listed;
    ASSERT_TRUE(server.stub().ListFeatures(call().get(), list, &listed).ok());
    EXPECT_EQ(listed.unit(), v1::INCH);
    ASSERT_GE(listed.features_size(), 1);
    v1::RemoveFeaturesRequest remove;
    remove.set_session(session);
    remove.add_ids(0);
    v1::RemoveFeaturesResponse removed;
    ASSERT_TRUE(server.stub().RemoveFeatures(call().get(), remove, &removed).ok());
    EXPECT_EQ(removed.source().unit(), v1::INCH);
    EXPECT_EQ(get_session(server.stub(), session).message.source().unit(), v1::INCH);
}

TEST(UnitsRpcsTest, DownloadsAreConverted) {
    TestServer server;
    const TriangleMesh mesh = icosphere(2);
    const std::string session = create(server, file_of(mesh), v1::INCH).message.id();
    TriangleMesh converted = mesh;
    for (Vec3& position : converted.positions) position = position * 127 / 5;
    EXPECT_EQ(read(download(server.stub(), download_in(session, v1::MILLIMETRE)).file).mesh, converted);
    EXPECT_EQ(read(download(server.stub(), download_in(session, v1::INCH)).file).mesh, mesh);
    EXPECT_EQ(read(download(server.stub(), download_in(session, v1::LENGTH_UNIT_UNSPECIFIED)).file).mesh, mesh);
    const Downloaded told = download(server.stub(), download_in(session, v1::MILLIMETRE, v1::THREE_MF));
    EXPECT_EQ(read(told.file).unit, LengthUnit::kMillimetre);
    EXPECT_EQ(read(told.file).mesh, converted);
    EXPECT_EQ(told.first.content_type(), "model/3mf");
    EXPECT_EQ(told.first.file_name(), "mesh-320.3mf");
    EXPECT_EQ(read(download(server.stub(), download_in(session, v1::LENGTH_UNIT_UNSPECIFIED, v1::THREE_MF)).file).unit,
              LengthUnit::kInch);

    v1::DownloadMeshRequest curved = download_in(session, v1::LENGTH_UNIT_UNSPECIFIED, v1::INP);
    curved.set_order(2);
    const std::string in_inches = download(server.stub(), curved).file;
    curved.set_unit(v1::MILLIMETRE);
    const std::string in_millimetres = download(server.stub(), curved).file;
    EXPECT_NE(in_inches, in_millimetres) << "nodes in the middle too";
    const auto last_node = [](const std::string& deck) {
        const std::string node = "\n642, ";
        return std::stod(deck.substr(deck.find(node) + node.size()));
    };
    EXPECT_NEAR(last_node(in_millimetres), 25.4 * last_node(in_inches), 1e-12);
}

TEST(UnitsRpcsTest, NothingIsConvertedFromAnUnknownUnit) {
    TestServer server;
    const std::string session = session_with(server.stub(), cube());
    EXPECT_TRUE(failed_with(download(server.stub(), download_in(session, v1::METRE)).status, Cause::kInvalidOption, "unit"));
    const v1::DownloadMeshRequest says = download_in(session, v1::LENGTH_UNIT_UNSPECIFIED, v1::THREE_MF);
    EXPECT_TRUE(failed_with(download(server.stub(), says).status, Cause::kInvalidOption, "unit"));
    EXPECT_TRUE(failed_with(download(server.stub(), download_in(session, static_cast<v1::LengthUnit>(99))).status,
                            Cause::kInvalidOption, "unit"));
}

}  // namespace
}  // namespace vsplit::test

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <optional>
#include <random>
#include <string>
#include <vector>

#include "test_client.h"
#include "test_server.h"
#include "tests/core/edited_mrr.h"
#include "tests/core/meshes.h"
#include "vsplit/io/read_mesh.h"
#include "vsplit/quality/mesh_quality.h"

namespace vsplit::test {
namespace {

using ::testing::HasSubstr;

class ResolutionRpcsTest : public ::testing::Test {
protected:
    void SetUp() override {
        Received received = improve(server_.stub(), small_improve(session_));
        ASSERT_TRUE(received.status.ok()) << received.status.error_message();
        made_ = *received.representation;
        ASSERT_GT(made_.faces_max(), made_.faces());
        ASSERT_GT(made_.faces(), made_.faces_min());
    }

    v1::SetResolutionRequest request(std::uint32_t held, std::uint32_t faces) const {
        v1::SetResolutionRequest r;
        r.set_session(session_);
        r.set_faces_held(held);
        r.set_faces(faces);
        return r;
    }

    void expect_download(const ProgressiveMesh& mesh) {
        const std::uint32_t faces = mesh.mesh().face_count();
        for (const auto& [format, wire_format] : {std::pair{MeshFormat::kPlyBinary, v1::PLY},
                                                  {MeshFormat::kStlBinary, v1::STL},
                                                  {MeshFormat::kObj, v1::OBJ},
                                                  {MeshFormat::kOff, v1::OFF}}) {
            const Downloaded file = download(server_.stub(), session_, "r1", faces, wire_format);
            ASSERT_TRUE(file.status.ok());
            EXPECT_EQ(file.first.faces(), faces);
            EXPECT_EQ(file.file, file_of(mesh.mesh(), format)) << faces << " faces as " << format_name(format);
        }
    }

    TestServer server_;
    const std::string session_ = session_with(server_.stub(), torus(20, 12));
    v1::Representation made_;
};

TEST_F(ResolutionRpcsTest, WhoHoldsNothingGetsWhatDownloadMeshGives) {
    for (const std::uint32_t faces : {made_.faces_min(), made_.faces(), made_.faces_max()}) {
        const Received received = set_resolution(server_.stub(), request(0, faces));
        ASSERT_TRUE(received.status.ok()) << received.status.error_message();
        ASSERT_TRUE(received.mesh && received.representation);
        EXPECT_EQ(received.representation->faces(), faces);
        EXPECT_EQ(received.mesh->mesh().face_count(), faces);
        expect_download(*received.mesh);
    }
}

TEST_F(ResolutionRpcsTest, TheBaseMeshAnnouncesHowManySplitsCome) {
    for (const v1::RecordEncoding encoding : {v1::FLOAT64, v1::FLOAT32}) {
        for (const std::uint32_t faces : {made_.faces_min(), made_.faces(), made_.faces_max()}) {
            v1::SetResolutionRequest wanted = request(0, faces);
            wanted.set_encoding(encoding);
            grpc::ClientContext context;
            const auto reader = server_.stub().SetResolution(&context, wanted);
            int parts = 0;
            for (v1::ProgressiveEvent event; reader->Read(&event);) {
                if (!event.has_base_mesh()) continue;
                ++parts;
                EXPECT_EQ(event.base_mesh().splits(), (faces - made_.faces_min()) / 2);
            }
            EXPECT_TRUE(reader->Finish().ok());
            EXPECT_GT(parts, 0);
        }
    }
}

TEST_F(ResolutionRpcsTest, ClimbsAndDescendsAtRandom) {
    Received received = set_resolution(server_.stub(), request(0, made_.faces_min()));
    ASSERT_TRUE(received.status.ok() && received.mesh);
    std::mt19937 random(11);
    for (int i = 0; i < 12; ++i) {
        const std::uint32_t held = received.mesh->mesh().face_count();
        const std::uint32_t levels = (made_.faces_max() - made_.faces_min()) / 2;
        const std::uint32_t faces = made_.faces_min() + 2 * (static_cast<std::uint32_t>(random()) % (levels + 1));
        received = set_resolution(server_.stub(), request(held, faces), std::move(received.mesh));
        ASSERT_TRUE(received.status.ok()) << received.status.error_message();
        EXPECT_EQ(received.base_parts, 0U);
        EXPECT_EQ(received.representation->faces(), faces);
        if (faces < held) {
            EXPECT_EQ(received.records, 0U) << "the client undoes its own";
            received.mesh->coarsen((held - faces) / 2);
        }
        EXPECT_EQ(received.mesh->mesh().face_count(), faces);
        expect_download(*received.mesh);
    }
}

/// Representations with records of all kinds, closed and open, put into a session as a method would.
class EditedRepresentationTest : public ::testing::Test {
protected:
    void put(const TriangleMesh& mesh) {
        mrr_ = edited_mrr(mesh, 400, 21).mrr;
        ASSERT_GT(mrr_.records.flips().size(), 50U);
        ASSERT_GT(mrr_.records.moves().size(), 50U);
        MethodResult result;
        result.mrr = mrr_;
        result.faces = mrr_.faces_at(mrr_.levels() / 2);
        result.quality = measure_quality(mesh_at(mrr_, mrr_.levels() / 2));
        session_ = session_with(server_.stub(), torus(20, 12));
        const auto session = server_.service().sessions().find(session_);
        ASSERT_TRUE(session);
        ASSERT_TRUE((*session)->add_representation({}, result));
    }

    Received ask(std::uint32_t held, std::size_t level, std::optional<ProgressiveMesh> mesh, std::uint32_t resume_from = 0) {
        v1::SetResolutionRequest request;
        request.set_session(session_);
        request.set_faces_held(held);
        request.set_faces(mrr_.faces_at(level));
        request.set_resume_from(resume_from);
        return set_resolution(server_.stub(), request, std::move(mesh));
    }

    void expect_level(const Received& received, std::size_t level) {
        ASSERT_TRUE(received.status.ok() && received.mesh) << received.status.error_message();
        EXPECT_EQ(received.mesh->level(), level);
        EXPECT_EQ(received.mesh->records(), mrr_.record_of_level(level));
        EXPECT_EQ(received.representation->faces(), mrr_.faces_at(level));
        EXPECT_EQ(received.mesh->visible(), mesh_at(mrr_, level));
        const Downloaded file = download(server_.stub(), session_, "r1", mrr_.faces_at(level), v1::PLY);
        ASSERT_TRUE(file.status.ok());
        EXPECT_EQ(file.file, file_of(received.mesh->visible(), MeshFormat::kPlyBinary)) << "level " << level;
    }

    TestServer server_;
    std::string session_;
    MultiresMesh mrr_;
};

TEST_F(EditedRepresentationTest, StreamedIsDownloadedByteForByte) {
    for (const TriangleMesh& mesh : {torus(40, 20), punctured(torus(40, 20), {0, 405, 610}), square(20)}) {
        ASSERT_NO_FATAL_FAILURE(put(mesh));
        Received received = ask(0, 0, std::nullopt);
        expect_level(received, 0);
        std::mt19937 random(3);
        for (int i = 0; i < 8; ++i) {
            const std::size_t level = random() % (mrr_.levels() + 1);
            const std::size_t held = received.mesh->level();
            received = ask(mrr_.faces_at(held), level, std::move(received.mesh));
            if (level < held) received.mesh->coarsen(held - level);
            expect_level(received, level);
        }
    }
}

TEST_F(EditedRepresentationTest, ResumesBetweenTwoSplits) {
    ASSERT_NO_FATAL_FAILURE(put(punctured(torus(40, 20), {0, 405, 610})));
    std::size_t broken = mrr_.records.size() / 2;
    while (mrr_.records.kinds()[broken - 1] == RecordKind::kSplit) ++broken;  // ends with an edit
    auto mesh = ProgressiveMesh::from_base(mrr_.base, mrr_.ghosts);
    ASSERT_TRUE(mesh && mesh->refine(mrr_.records.slice(0, broken)));
    const std::uint32_t held = mrr_.faces_at(mesh->level());
    const Received rest = ask(held, mrr_.levels(), *mesh, static_cast<std::uint32_t>(broken));
    EXPECT_EQ(rest.base_parts, 0U);
    EXPECT_EQ(rest.records, mrr_.records.size() - broken);
    expect_level(rest, mrr_.levels());
}

TEST_F(ResolutionRpcsTest, OutOfRangeGivesTheNearestAndSaysWhich) {
    EXPECT_EQ(set_resolution(server_.stub(), request(0, 1)).representation->faces(), made_.faces_min());
    EXPECT_EQ(set_resolution(server_.stub(), request(0, 4000000000U)).representation->faces(), made_.faces_max());
    EXPECT_EQ(set_resolution(server_.stub(), request(0, made_.faces() + 1)).representation->faces(), made_.faces());
    EXPECT_EQ(download(server_.stub(), session_, "r1", 4000000000U).first.faces(), made_.faces_max());
    EXPECT_EQ(get_quality(server_.stub(), session_, "r1", 1).message.faces(), made_.faces_min());
}

TEST_F(ResolutionRpcsTest, TheRepresentationDescribesTheResolutionAskedFor) {
    const Received received = set_resolution(server_.stub(), request(0, made_.faces_max()));
    ASSERT_TRUE(received.status.ok() && received.mesh);
    const Quality own = measure_quality(received.mesh->mesh());
    EXPECT_EQ(received.representation->quality().faces(), made_.faces_max());
    EXPECT_EQ(received.representation->quality().stretch_mean(), own.stretch_mean);
    EXPECT_EQ(received.representation->quality().valence_max(), own.valence_max);
    EXPECT_EQ(received.representation->faces_min(), made_.faces_min());
    const Received back = set_resolution(server_.stub(), request(0, made_.faces()));
    EXPECT_EQ(back.representation->DebugString(), made_.DebugString());
}

TEST_F(ResolutionRpcsTest, ResumesWhereAStreamBrokeOff) {
    Received part = set_resolution(server_.stub(), request(0, made_.faces()));
    ASSERT_TRUE(part.status.ok() && part.mesh);
    const auto have = static_cast<std::uint32_t>(part.mesh->records());
    const std::size_t level = part.mesh->level();
    v1::SetResolutionRequest rest = request(0, made_.faces_max());
    rest.set_resume_from(have);
    const Received received = set_resolution(server_.stub(), rest, std::move(part.mesh));
    ASSERT_TRUE(received.status.ok());
    EXPECT_EQ(received.base_parts, 0U);
    EXPECT_EQ(received.mesh->level() - level, (made_.faces_max() - made_.faces()) / 2);
    EXPECT_EQ(received.records, received.mesh->records() - have);
    expect_download(*received.mesh);
}

TEST_F(ResolutionRpcsTest, RefusesWhatIsNoResolutionNamingTheNearest) {
    const Received odd = set_resolution(server_.stub(), request(made_.faces() + 1, made_.faces_max()));
    EXPECT_TRUE(failed_with(odd.status, Cause::kInvalidOption, "faces_held"));
    EXPECT_THAT(odd.status.error_message(), HasSubstr("the nearest is " + std::to_string(made_.faces())));
    v1::SetResolutionRequest beyond = request(0, made_.faces());
    beyond.set_resume_from(4000000000U);
    EXPECT_TRUE(failed_with(set_resolution(server_.stub(), beyond).status, Cause::kInvalidOption, "resume_from"));
    v1::SetResolutionRequest encoding = request(0, made_.faces());
    encoding.set_encoding(static_cast<v1::RecordEncoding>(99));
    EXPECT_TRUE(failed_with(set_resolution(server_.stub(), encoding).status, Cause::kInvalidOption, "encoding"));
}

TEST_F(ResolutionRpcsTest, TakesTheNewestRepresentationUnlessToldOtherwise) {
    v1::ControlRequest control_request;
    control_request.set_session(session_);
    control_request.mutable_options()->set_tolerance(0.05);
    ASSERT_TRUE(control(server_.stub(), control_request).status.ok());
    EXPECT_EQ(set_resolution(server_.stub(), request(0, 1)).representation->id(), "r2");
    v1::SetResolutionRequest first = request(0, 1);
    first.set_representation("r1");
    EXPECT_EQ(set_resolution(server_.stub(), first).representation->id(), "r1");
    first.set_representation("r3");
    EXPECT_TRUE(failed_with(set_resolution(server_.stub(), first).status, Cause::kNotFound, "representation"));
}

TEST_F(ResolutionRpcsTest, ControlsBoundsAreJudgedAtTheResolutionAskedFor) {
    v1::ControlRequest control_request;
    control_request.set_session(session_);
    control_request.mutable_options()->set_tolerance(0.2);
    control_request.mutable_options()->set_max_valence(100);
    control_request.mutable_options()->set_min_stretch(0.01);
    control_request.mutable_options()->set_max_size(0.3);  // the finest resolution holds it, the coarsest cannot
    const Received made = control(server_.stub(), control_request);
    ASSERT_TRUE(made.status.ok()) << made.status.error_message();
    for (const std::uint32_t faces : {made.representation->faces_min(), made.representation->faces_max()}) {
        const Received at = set_resolution(server_.stub(), request(0, faces));
        ASSERT_TRUE(at.status.ok());
        const bool holds = at.representation->quality().size_max() <= 0.3 && at.representation->quality().stretch_min() >= 0.01;
        EXPECT_EQ(at.representation->bounds_satisfied(), holds) << faces;
        EXPECT_EQ(at.representation->violations_size() == 0, holds);
    }
}

TEST_F(ResolutionRpcsTest, DownloadDescribesTheFile) {
    const Downloaded upload_file = download(server_.stub(), session_, "", 0, v1::MESH_FORMAT_UNSPECIFIED);
    ASSERT_TRUE(upload_file.status.ok());
    EXPECT_EQ(upload_file.first.size(), upload_file.file.size());
    EXPECT_EQ(upload_file.first.file_name(), "mesh-480.stl");
    EXPECT_EQ(upload_file.first.content_type(), "model/stl");
    EXPECT_EQ(upload_file.first.faces(), 480U);
    EXPECT_EQ(upload_file.file, file_of(torus(20, 12), MeshFormat::kStlBinary));
    const Downloaded ascii = download(server_.stub(), session_, "r1", 0, v1::PLY_ASCII);
    EXPECT_EQ(ascii.first.file_name(), "r1-" + std::to_string(made_.faces()) + ".ply");
    EXPECT_EQ(ascii.first.content_type(), "text/plain");
}

TEST_F(ResolutionRpcsTest, DownloadsLargeFilesInParts) {
    const TriangleMesh large = torus(200, 100);
    const std::string id = create_session(server_.stub()).message.id();
    ASSERT_TRUE(upload(server_.stub(), id, file_of(large), 100000).status.ok());
    const Downloaded file = download(server_.stub(), id, "", 0, v1::STL);
    EXPECT_GT(file.first.size(), std::uint64_t{4} * 256 * 1024);
    EXPECT_EQ(file.file, file_of(large, MeshFormat::kStlBinary));
}

TEST_F(ResolutionRpcsTest, RefusesAFormatItDoesNotKnow) {
    EXPECT_TRUE(failed_with(download(server_.stub(), session_, "", 0, static_cast<v1::MeshFormat>(77)).status,
                            Cause::kInvalidOption, "format"));
}

TEST_F(ResolutionRpcsTest, QualityIsWhatTheEngineMeasures) {
    const Reply<v1::Quality> of_upload = get_quality(server_.stub(), session_);
    ASSERT_TRUE(of_upload.status.ok());
    EXPECT_EQ(of_upload.message.faces(), 480U);
    EXPECT_EQ(of_upload.message.worst_faces_size(), 20);
    EXPECT_EQ(of_upload.message.stretch_histogram_size(), 20);
    const std::string file = download(server_.stub(), session_, "r1", made_.faces_max()).file;
    const Expected<ReadResult> mesh = read_mesh(std::as_bytes(std::span(file)), {});
    ASSERT_TRUE(mesh);
    const Reply<v1::Quality> finest = get_quality(server_.stub(), session_, "r1", made_.faces_max(), 3);
    EXPECT_NEAR(finest.message.stretch_mean(), measure_quality(mesh->mesh).stretch_mean, 1e-12);
    ASSERT_EQ(finest.message.worst_faces_size(), 3);
    EXPECT_EQ(finest.message.worst_faces(0).stretch(), finest.message.stretch_min());
    EXPECT_TRUE(failed_with(get_quality(server_.stub(), session_, "", 0, 1001).status, Cause::kInvalidOption, "worst"));
}

TEST_F(ResolutionRpcsTest, ASessionWithoutMeshOrRepresentationSaysWhatToDo) {
    const std::string empty = create_session(server_.stub()).message.id();
    EXPECT_TRUE(failed_with(download(server_.stub(), empty).status, Cause::kNotReady, "session"));
    EXPECT_TRUE(failed_with(get_quality(server_.stub(), empty).status, Cause::kNotReady, "session"));
    EXPECT_TRUE(failed_with(improve(server_.stub(), small_improve(empty)).status, Cause::kNotReady, "session"));
    v1::SetResolutionRequest r = request(0, 1);
    r.set_session(session_with(server_.stub(), cube()));
    EXPECT_TRUE(failed_with(set_resolution(server_.stub(), r).status, Cause::kNotReady, "session"));
}

}  // namespace
}  // namespace vsplit::test

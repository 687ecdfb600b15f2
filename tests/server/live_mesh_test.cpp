#include "vsplit/client/live_mesh.h"

#include <gtest/gtest.h>

#include <chrono>
#include <span>

#include "cutting_proxy.h"
#include "test_client.h"
#include "test_server.h"
#include "tests/core/meshes.h"
#include "tests/core/random.h"
#include "vsplit/io/read_mesh.h"

namespace vsplit::test {
namespace {

using client::LiveMesh;
using client::MeshingClient;
using client::MeshReceiver;

const std::vector<EncodingChoice> kChoices = {
    {RecordEncoding::kFloat64, 0}, {RecordEncoding::kFloat32, 0}, {RecordEncoding::kQuantised, 14}};

/// A representation of about 10,000 faces that has records of all kinds.
class LiveMeshTest : public ::testing::Test {
protected:
    void SetUp() override {
        v1::ImproveRequest request;
        request.set_session(session_);
        request.mutable_options()->set_subdivision_size(0.06);
        request.mutable_options()->set_faces(3000);
        const Received received = improve(server_.stub(), request);
        ASSERT_TRUE(received.status.ok()) << received.status.error_message();
        made_ = *received.representation;
        ASSERT_GT(made_.faces_max(), 3000U);
        ASSERT_GT(made_.records().moves(), 100U);
    }

    [[nodiscard]] MeshingClient connect(int port = 0) const {
        const std::string target = "127.0.0.1:" + std::to_string(port == 0 ? server_.server().port() : port);
        Expected<MeshingClient> client = MeshingClient::connect(target);
        EXPECT_TRUE(client) << client.error().message;
        return *std::move(client);
    }
    [[nodiscard]] client::ResolutionTarget target(std::uint32_t faces, const EncodingChoice& choice) const {
        return {session_, made_.id(), faces, choice};
    }
    /// What DownloadMesh gives, every position rounded to the encoding's.
    [[nodiscard]] TriangleMesh downloaded(std::uint32_t faces, const PositionGrid& grid) {
        const Downloaded file = download(server_.stub(), session_, made_.id(), faces, v1::PLY);
        EXPECT_TRUE(file.status.ok()) << file.status.error_message();
        Expected<ReadResult> read = read_mesh(std::as_bytes(std::span(file.file)), {});
        EXPECT_TRUE(read) << read.error().message;
        TriangleMesh mesh = std::move(read->mesh);
        for (Vec3& position : mesh.positions) position = grid.snap(position);
        return mesh;
    }
    [[nodiscard]] PositionGrid grid(const EncodingChoice& choice) {
        const auto snapshot = server_.service().snapshot(session_);
        return *PositionGrid::over((*snapshot->representations.back()->levels().get())->mrr(), choice);
    }
    [[nodiscard]] std::uint32_t some_faces() {
        return made_.faces_min() + random_.below(made_.faces_max() - made_.faces_min() + 1);
    }

    /// Goes from the coarsest to the finest until fifty connections have been cut on the way.
    void cut_fifty_times(const EncodingChoice& choice) {
        CuttingProxy proxy(server_.server().port());
        MeshingClient client = connect(proxy.port());
        const TriangleMesh finest = downloaded(made_.faces_max(), grid(choice));
        // Sometimes within a block, which comes anew, sometimes between two.
        const std::size_t most = choice.encoding == RecordEncoding::kFloat64 ? 400'000 : 150'000;
        const client::ResumeOptions resume{50, std::chrono::milliseconds(2), std::chrono::milliseconds(20)};
        for (int round = 0; round < 100 && proxy.cuts() < 50; ++round) {
            proxy.cut_every(0, 0);
            MeshReceiver receiver;
            ASSERT_TRUE(move_to(client, target(made_.faces_min(), choice), receiver));
            proxy.cut_every(2000, most);
            std::uint32_t held = receiver.records_held();
            for (std::uint32_t part = 1; part <= 4; ++part) {
                const std::uint32_t faces = made_.faces_min() + (made_.faces_max() - made_.faces_min()) / 4 * part;
                const auto shown = move_to(client, target(part == 4 ? made_.faces_max() : faces, choice), receiver, resume);
                ASSERT_TRUE(shown) << shown.error().message;
                ASSERT_GT(receiver.records_held(), held);  // whoever began anew would hold the base first
                held = receiver.records_held();
            }
            ASSERT_EQ(receiver.mesh(), finest);
        }
        EXPECT_GE(proxy.cuts(), 50);
    }

    mutable TestServer server_;
    const std::string session_ = session_with(server_.stub(), bumpy_sphere(3, 0.02, 5));
    v1::Representation made_;
    Random random_{7};
};

TEST_F(LiveMeshTest, AThousandJumpsOverOneConnectionGiveWhatDownloadMeshGives) {
    MeshingClient client = connect();
    for (const EncodingChoice& choice : kChoices) {
        const PositionGrid rounding = grid(choice);
        // Who goes back and forth, and who begins anew each time.
        MeshReceiver kept;
        for (int jump = 0; jump < 334; ++jump) {
            MeshReceiver fresh;
            MeshReceiver& receiver = jump % 4 == 3 ? fresh : kept;
            const std::uint32_t faces = some_faces();
            const auto shown = move_to(client, target(faces, choice), receiver);
            ASSERT_TRUE(shown) << shown.error().message;
            ASSERT_LE(*shown, faces);
            ASSERT_EQ(receiver.mesh(), downloaded(faces, rounding)) << "jump " << jump << " to " << faces;
            if (jump % 40 == 39) kept = MeshReceiver();
        }
    }
}

TEST_F(LiveMeshTest, JumpsByKeyframesGiveWhatDownloadMeshGives) {
    MeshingClient client = connect();
    MeshReceiver receiver;
    client::ResolutionTarget to = target(0, kChoices[0]);
    to.keyframes = true;
    int keyframes = 0, records = 0;
    for (int jump = 0; jump < 100; ++jump) {
        if (jump % 20 == 19) receiver = MeshReceiver();
        const bool from_nothing = !receiver.has_mesh();
        to.faces = from_nothing ? made_.faces_max() - 50 * static_cast<std::uint32_t>(jump) : some_faces();
        const std::uint32_t least = from_nothing ? 0 : receiver.held().faces_min();
        const auto shown = move_to(client, to, receiver);
        ASSERT_TRUE(shown) << shown.error().message;
        ASSERT_EQ(receiver.mesh(), downloaded(to.faces, PositionGrid())) << "jump " << jump << " to " << to.faces;
        if (receiver.on_keyframe() && receiver.held().faces_min() != least) ++keyframes;
        if (receiver.held().levels() > 0) ++records;
    }
    EXPECT_GT(keyframes, 5);
    EXPECT_GT(records, 5);
}

TEST_F(LiveMeshTest, AKeyframeIsLessToReceiveAndKeepsWhatWasThere) {
    MeshingClient client = connect();
    MeshReceiver receiver;
    client::ResolutionTarget to = target(made_.faces_min(), kChoices[0]);
    to.keyframes = true;
    ASSERT_TRUE(move_to(client, to, receiver));
    const TriangleMesh coarsest = receiver.mesh();
    ASSERT_FALSE(receiver.on_keyframe());
    to.faces = made_.faces_max();
    ASSERT_TRUE(move_to(client, to, receiver));
    ASSERT_TRUE(receiver.on_keyframe());
    EXPECT_EQ(receiver.mesh(), downloaded(made_.faces_max(), PositionGrid()));
    EXPECT_EQ(receiver.records_held(), made_.records().splits() + made_.records().flips() + made_.records().moves());
    // Down again without a server.
    MeshingClient nobody = std::move(client);
    server_.server().shutdown(std::chrono::milliseconds(0));
    to.faces = made_.faces_min();
    const auto shown = move_to(nobody, to, receiver);
    ASSERT_TRUE(shown) << shown.error().message;
    EXPECT_EQ(receiver.mesh(), coarsest);
    EXPECT_FALSE(receiver.on_keyframe());
}

TEST_F(LiveMeshTest, AConnectionThatIsCutFiftyTimesStartsNothingOver) { cut_fifty_times(kChoices[0]); }
TEST_F(LiveMeshTest, NorInSinglePrecision) { cut_fifty_times(kChoices[1]); }
TEST_F(LiveMeshTest, NorQuantised) { cut_fifty_times(kChoices[2]); }

TEST_F(LiveMeshTest, AStreamThatBreaksBehindItsBaseMeshLosesNoRegions) {
    TriangleMesh halves = bumpy_sphere(2, 0.02, 5);
    for (std::uint32_t f = 0; f < halves.face_count(); ++f) halves.regions.push_back(1 + 2 * f / halves.face_count());
    v1::ImproveRequest request;
    request.set_session(session_with(server_.stub(), halves));
    const Received received = improve(server_.stub(), request);
    ASSERT_TRUE(received.status.ok()) << received.status.error_message();
    const client::ResolutionTarget to{request.session(), received.representation->id(), received.representation->faces_max(), {}};
    MeshingClient client = connect();
    MeshReceiver whole, broken;
    ASSERT_TRUE(move_to(client, to, whole));
    ASSERT_FALSE(whole.mesh().regions.empty());

    client::EventHandlers handlers = broken.handlers();
    handlers.on_regions = [](const v1::Regions&) { return Error{Cause::kCancelled, "the connection is lost", ""}; };
    v1::SetResolutionRequest first;
    first.set_session(to.session);
    first.set_representation(to.representation);
    first.set_faces(to.faces);
    ASSERT_FALSE(client.set_resolution(first, handlers));
    ASSERT_TRUE(broken.has_mesh());
    ASSERT_TRUE(move_to(client, to, broken));
    EXPECT_EQ(broken.mesh(), whole.mesh());
}

TEST_F(LiveMeshTest, FetchBringsAMeshUpToDateByRanges) {
    MeshingClient client = connect();
    LiveMesh live(client, target(made_.faces_min(), kChoices[2]));
    TriangleMesh mine;
    std::size_t elements = 0, all = 0;
    for (int step = 0; step < 30; ++step) {
        const std::uint32_t faces = step % 3 == 0 ? some_faces() : made_.faces_min() + static_cast<std::uint32_t>(step);
        live.go_to(some_faces());  // is overtaken
        live.go_to(faces);
        static_cast<void>(live.fetch(mine));
        const auto shown = live.wait();
        ASSERT_TRUE(shown) << shown.error().message;
        const TriangleMesh before = mine;
        const client::MeshUpdate update = live.fetch(mine);
        ASSERT_EQ(mine, downloaded(faces, grid(kChoices[2])));
        // What no range names is what it was.
        TriangleMesh mended = before;
        mended.faces.resize(mine.faces.size());
        mended.positions.resize(mine.positions.size());
        for (const auto& range : update.faces) {
            elements += range.count;
            std::copy_n(mine.faces.begin() + range.first, range.count, mended.faces.begin() + range.first);
        }
        for (const auto& range : update.vertices)
            std::copy_n(mine.positions.begin() + range.first, range.count, mended.positions.begin() + range.first);
        ASSERT_EQ(mended, mine);
        all += mine.faces.size();
        EXPECT_TRUE(live.fetch(mine).faces.empty());
    }
    EXPECT_LT(elements, all);
}

TEST_F(LiveMeshTest, TellsWhatCannotBeMended) {
    MeshingClient client = connect();
    client::ResolutionTarget nowhere = target(100, kChoices[0]);
    nowhere.session = "none";
    LiveMesh live(client, nowhere);
    EXPECT_EQ(live.wait().error().cause, Cause::kNotFound);
}

}  // namespace
}  // namespace vsplit::test

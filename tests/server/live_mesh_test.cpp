#include "vsplit/client/live_mesh.h"

#include <gtest/gtest.h>

#include <chrono>

#include "stream_test.h"
#include "test_client.h"
#include "tests/core/meshes.h"

namespace vsplit::test {
namespace {

using client::LiveMesh;
using client::MeshingClient;
using client::MeshReceiver;

const std::vector<EncodingChoice> kChoices = {
    {RecordEncoding::kFloat64, 0}, {RecordEncoding::kFloat32, 0}, {RecordEncoding::kQuantised, 14}};

/// A representation of about 10,000 faces that has records of all kinds.
class LiveMeshTest : public StreamTest {
protected:
    void SetUp() override {
        v1::ImproveOptions options;
        options.set_subdivision_size(0.06);
        options.set_faces(3000);
        improve_session(session_with(server_.stub(), bumpy_sphere(3, 0.02, 5)), options);
        ASSERT_GT(made_.faces_max(), 3000U);
        ASSERT_GT(made_.records().moves(), 100U);
    }
};

TEST_F(LiveMeshTest, AThousandJumpsOverOneConnectionGiveWhatDownloadMeshGives) {
    for (const EncodingChoice& choice : kChoices) jump(choice, 334);
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
        ASSERT_TRUE(file_of(receiver.mesh()) == downloaded(to.faces, PositionGrid())) << "jump " << jump << " to " << to.faces;
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
    EXPECT_TRUE(file_of(receiver.mesh()) == downloaded(made_.faces_max(), PositionGrid()));
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
        ASSERT_TRUE(file_of(mine) == downloaded(faces, grid(kChoices[2])));
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

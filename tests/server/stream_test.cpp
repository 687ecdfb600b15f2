#include "stream_test.h"

#include <chrono>
#include <cstring>
#include <string_view>

#include "cutting_proxy.h"
#include "test_client.h"

namespace vsplit::test {

using client::MeshingClient;
using client::MeshReceiver;

void StreamTest::improve_session(const std::string& session, const v1::ImproveOptions& options) {
    session_ = session;
    v1::ImproveRequest request;
    request.set_session(session);
    *request.mutable_options() = options;
    const Received received = improve(server_.stub(), request);
    ASSERT_TRUE(received.status.ok()) << received.status.error_message();
    made_ = *received.representation;
}

MeshingClient StreamTest::connect(int port) const {
    const std::string target = "127.0.0.1:" + std::to_string(port == 0 ? server_.port() : port);
    Expected<MeshingClient> client = MeshingClient::connect(target);
    EXPECT_TRUE(client) << client.error().message;
    return *std::move(client);
}

PositionGrid StreamTest::grid(const EncodingChoice& choice) {
    const auto snapshot = server_.service().snapshot(session_);
    return *PositionGrid::over((*snapshot->representations.back()->levels().get())->mrr(), choice);
}

std::string StreamTest::downloaded(std::uint32_t faces, const PositionGrid& grid) {
    Downloaded got = download(server_.stub(), session_, made_.id(), faces, v1::PLY);
    EXPECT_TRUE(got.status.ok()) << got.status.error_message();
    static constexpr std::string_view kCount = "element vertex ", kEnd = "end_header\n";
    const std::size_t vertices = std::stoul(got.file.substr(got.file.find(kCount) + kCount.size(), 20));
    char* at = got.file.data() + got.file.find(kEnd) + kEnd.size();
    for (std::size_t v = 0; v < vertices; ++v, at += sizeof(Vec3)) {
        Vec3 position;
        std::memcpy(position.data(), at, sizeof(Vec3));
        position = grid.snap(position);
        std::memcpy(at, position.data(), sizeof(Vec3));
    }
    return std::move(got.file);
}

void StreamTest::jump(const EncodingChoice& choice, int jumps) {
    MeshingClient client = connect();
    const PositionGrid rounding = grid(choice);
    MeshReceiver receiver;
    for (int jump = 0; jump < jumps; ++jump) {
        if (jump % 8 == 0) receiver = MeshReceiver();  // who holds the finest asks for nothing more
        const std::uint32_t faces = some_faces();
        const auto shown = move_to(client, target(faces, choice), receiver);
        ASSERT_TRUE(shown) << shown.error().message;
        ASSERT_LE(*shown, faces);
        ASSERT_TRUE(file_of(receiver.mesh()) == downloaded(faces, rounding)) << "jump " << jump << " to " << faces;
    }
}

void StreamTest::climb(MeshingClient& client, MeshReceiver& receiver, const EncodingChoice& choice) {
    const client::ResumeOptions resume{50, std::chrono::milliseconds(2), std::chrono::milliseconds(20)};
    const Vec3* const base = receiver.held().base.positions.data();
    for (std::uint32_t part = 1; part <= 4; ++part) {
        const std::uint32_t faces = made_.faces_min() + (made_.faces_max() - made_.faces_min()) / 4 * part;
        const auto shown = move_to(client, target(part == 4 ? made_.faces_max() : faces, choice), receiver, resume);
        ASSERT_TRUE(shown) << shown.error().message;
        ASSERT_EQ(receiver.held().base.positions.data(), base);  // of whoever begins anew it lies elsewhere
    }
}

void StreamTest::cut_fifty_times(const EncodingChoice& choice) {
    CuttingProxy proxy(server_.port());
    MeshingClient client = connect(proxy.port());
    const std::string finest = downloaded(made_.faces_max(), grid(choice));
    // Sometimes within a block, which comes anew, sometimes between two.
    const std::size_t most = choice.encoding == RecordEncoding::kFloat64 ? 400'000 : 150'000;
    for (int round = 0; round < 100 && proxy.cuts() < 50; ++round) {
        proxy.cut_every(0, 0);
        MeshReceiver receiver;
        ASSERT_TRUE(move_to(client, target(made_.faces_min(), choice), receiver));
        proxy.cut_every(2000, most);
        climb(client, receiver, choice);
        if (HasFatalFailure()) return;
        ASSERT_TRUE(file_of(receiver.mesh()) == finest);
    }
    EXPECT_GE(proxy.cuts(), 50);
}

}  // namespace vsplit::test

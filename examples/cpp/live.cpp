// live HOST:PORT SESSION REPRESENTATION FACES: what a program with a window does. A thread of LiveMesh's own receives and
// decodes; this one, which would draw, fetches every frame what changed, as ranges of vertices and faces to upload anew.
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <thread>

#include "vsplit/client/live_mesh.h"
#include "vsplit/client/meshing_client.h"

using namespace vsplit;

int main(int argc, char** argv) {
    if (argc != 5) return std::fprintf(stderr, "usage: live HOST:PORT SESSION REPRESENTATION FACES\n"), 1;
    auto client = client::MeshingClient::connect(argv[1]);
    if (!client) return std::fprintf(stderr, "live: %s\n", client.error().message.c_str()), 1;
    const auto wanted = static_cast<std::uint32_t>(std::strtoul(argv[4], nullptr, 10));

    client::LiveMesh live(*client, {argv[2], argv[3], 0, {RecordEncoding::kQuantised, 14}});
    live.go_to(wanted);  // returns at once; the newest wish counts
    TriangleMesh drawn;  // kept from frame to frame
    for (int frame = 0; frame < 20; ++frame) {
        std::size_t faces = 0;
        for (const client::ElementRange& range : live.fetch(drawn).faces) faces += range.count;
        std::printf("frame %d: %u faces, %zu of them new\n", frame, drawn.face_count(), faces);
        std::this_thread::sleep_for(std::chrono::milliseconds(16));
    }
    const auto shown = live.wait();
    if (!shown) return std::fprintf(stderr, "live: %s\n", shown.error().message.c_str()), 1;
    static_cast<void>(live.fetch(drawn));
    std::printf("%u faces\n", drawn.face_count());
    return 0;
}

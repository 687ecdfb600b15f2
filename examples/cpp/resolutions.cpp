// resolutions HOST:PORT MESH: sends a mesh to a server, improves it there, and goes through its resolutions here. What a stream
// brought is kept: going coarser asks the server nothing, and a connection that breaks is taken up where it broke.
#include <cstdio>

#include "vsplit/client/live_mesh.h"
#include "vsplit/client/mesh_receiver.h"
#include "vsplit/client/meshing_client.h"

using namespace vsplit;

namespace {

int failed(const Error& error) {
    std::fprintf(stderr, "resolutions: %s\n", error.message.c_str());
    return 1;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 3) return std::fprintf(stderr, "usage: resolutions HOST:PORT MESH\n"), 1;
    auto client = client::MeshingClient::connect(argv[1]);
    if (!client) return failed(client.error());
    const auto session = client->create_session();
    if (!session) return failed(session.error());

    client::UploadOptions upload;
    upload.on_progress = [](std::uint64_t sent, std::uint64_t total) {
        std::fprintf(stderr, "%llu of %llu bytes\n", static_cast<unsigned long long>(sent),
                     static_cast<unsigned long long>(total));
    };
    if (const auto uploaded = client->upload_mesh(session->id(), argv[2], upload); !uploaded) return failed(uploaded.error());

    v1::ImproveRequest request;
    request.set_session(session->id());
    request.set_encoding(v1::QUANTISED);  // the figures and files of the session stay exact
    request.set_quantisation_bits(16);
    client::MeshReceiver receiver;
    const auto made = client->improve(request, receiver.handlers());
    if (!made) return failed(made.error());

    client::ResolutionTarget target{session->id(), made->id(), 0, receiver.encoding()};
    for (const std::uint32_t faces : {made->faces_max(), made->faces_min(), made->faces()}) {
        target.faces = faces;
        const auto shown = client::move_to(*client, target, receiver);
        if (!shown) return failed(shown.error());
        std::printf("%u faces, %u vertices\n", *shown, receiver.mesh().vertex_count());
    }
    const Status deleted = client->delete_session(session->id());
    return deleted ? 0 : failed(deleted.error());
}

#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "vsplit/client/mesh_receiver.h"
#include "vsplit/client/meshing_client.h"

namespace vsplit::client {

/// How a stream that breaks off is taken up again.
using ResumeOptions = RetryOptions;

/// Brings `receiver` to the resolution nearest to `faces`: without the server where it holds that already, else by SetResolution
/// from what it holds on. Where the connection breaks (UNAVAILABLE) the stream goes on at the first record still missing, on a
/// new connection. The receiver holds whatever has come, also when this fails. \return the faces shown; what set_resolution
/// returns.
struct ResolutionTarget {
    std::string session;
    std::string representation;  ///< as the id that Improve or Control gave
    std::uint32_t faces = 0;
    EncodingChoice encoding;  ///< of a receiver that holds nothing; one that does goes on in its own
    /// kFloat64: a far jump may bring the mesh it leads to in place of the records between, where that is less to send. What was
    /// held before is kept; the levels between come when they are asked for.
    bool keyframes = false;
};
[[nodiscard]] Expected<std::uint32_t> move_to(MeshingClient& client, const ResolutionTarget& target, MeshReceiver& receiver,
                                              const ResumeOptions& resume = {}, const CallOptions& call = {});

/// Elements [first, first + count).
struct ElementRange {
    std::uint32_t first = 0;
    std::uint32_t count = 0;
};

/// What changed in a mesh since it was last looked at.
struct MeshUpdate {
    std::vector<ElementRange> vertices;  ///< ascending; to be uploaded anew
    std::vector<ElementRange> faces;
};

/// A mesh at a resolution that may be changed at any time, for a program with a thread that draws: a thread of this object's own
/// receives and decodes, and the program fetches what changed when it likes.
///
///     LiveMesh live(client, {session, representation, 0, {RecordEncoding::kQuantised, 14}});
///     live.go_to(200000);                          // returns at once; the newest wish counts
///     ... every frame:
///     TriangleMesh mine;                           // kept by the program
///     for (auto range : live.fetch(mine).faces) upload(mine.faces, range);
///
/// All members may be called from any thread; each call of `fetch` needs a mesh of its own kept from the call before. The client
/// must outlive this object. Memory: that of MeshReceiver, and once more what it shows.
class LiveMesh {
public:
    /// `target.faces` is where it begins to go.
    LiveMesh(MeshingClient& client, ResolutionTarget target, const ResumeOptions& resume = {});
    /// Stops what is under way.
    ~LiveMesh();
    LiveMesh(const LiveMesh&) = delete;
    LiveMesh& operator=(const LiveMesh&) = delete;

    /// Another resolution. A stream under way for the one before is left where it is; nothing that came is lost.
    void go_to(std::uint32_t faces);

    /// Blocks until the last wish is fulfilled or has failed. \return the faces shown, or why not.
    [[nodiscard]] Expected<std::uint32_t> wait();

    /// Makes `mesh` what is shown now, also while it is under way, and says which elements differ from what it was. Vertices and
    /// faces beyond the new counts are gone. O(mesh), a comparison.
    [[nodiscard]] MeshUpdate fetch(TriangleMesh& mesh);

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace vsplit::client

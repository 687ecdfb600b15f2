#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <string>

#include "test_server.h"
#include "tests/core/random.h"
#include "vsplit/client/live_mesh.h"
#include "vsplit/mrr/position_grid.h"

namespace vsplit::test {

/// A representation on a server, and clients of its records, which must show what DownloadMesh gives.
class StreamTest : public ::testing::Test {
protected:
    /// Makes the representation that all the others speak of, of a session that has a mesh.
    void improve_session(const std::string& session, const v1::ImproveOptions& options);

    /// By default to the server itself.
    [[nodiscard]] client::MeshingClient connect(int port = 0) const;
    [[nodiscard]] client::ResolutionTarget target(std::uint32_t faces, const EncodingChoice& choice) const {
        return {session_, made_.id(), faces, choice};
    }
    [[nodiscard]] PositionGrid grid(const EncodingChoice& choice);
    /// A binary PLY file as DownloadMesh gives it, every position rounded to the encoding's.
    [[nodiscard]] std::string downloaded(std::uint32_t faces, const PositionGrid& grid);
    [[nodiscard]] std::uint32_t some_faces() {
        return made_.faces_min() + random_.below(made_.faces_max() - made_.faces_min() + 1);
    }

    /// Jumps to random resolutions over one connection; after each the mesh is what DownloadMesh gives.
    void jump(const EncodingChoice& choice, int jumps);
    /// Goes from the coarsest to the finest until fifty connections have been cut on the way, and starts nothing over.
    void cut_fifty_times(const EncodingChoice& choice);

    TestServer server_;
    std::string session_;
    v1::Representation made_;
    Random random_{7};

private:
    /// Once up, in four steps, over what is cut.
    void climb(client::MeshingClient& client, client::MeshReceiver& receiver, const EncodingChoice& choice);
};

}  // namespace vsplit::test

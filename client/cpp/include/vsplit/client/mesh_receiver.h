#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>

#include "vsplit/base/expected.h"
#include "vsplit/client/call_options.h"
#include "vsplit/mrr/multires_mesh.h"
#include "vsplit/mrr/progressive_mesh.h"

namespace vsplit::client {

/// Keeps what Improve, Control and SetResolution stream, and builds the mesh from it at any resolution that has arrived.
///
///     MeshReceiver receiver;
///     auto made = client.improve(request, receiver.handlers());
///     if (made) use(receiver.mesh());
///     if (Status shown = receiver.show(2000); shown) use(receiver.mesh());   // coarser: needs no server
///
/// Everything that comes is checked by ProgressiveMesh before it is kept. Not thread-safe. Memory: that of ProgressiveMesh and
/// 56 bytes a split.
class MeshReceiver {
public:
    /// `max_faces`: LIMIT_EXCEEDED when a stream builds more.
    explicit MeshReceiver(std::uint32_t max_faces = 50'000'000) : max_faces_(max_faces) {}

    /// Handlers that feed this object, which must outlive them.
    [[nodiscard]] EventHandlers handlers(std::function<void(const v1::Progress&)> on_progress = {});

    /// Starts anew with a base mesh. \return what ProgressiveMesh::from_base returns, LIMIT_EXCEEDED.
    [[nodiscard]] Status begin(TriangleMesh base);

    /// Adds splits and shows them. \return OUT_OF_ORDER when `first` is not the number of splits held or no base mesh came
    /// before; CORRUPT for a split that does not fit the mesh; LIMIT_EXCEEDED.
    [[nodiscard]] Status append(std::uint32_t first, std::span<const VertexSplit> splits);

    /// Moves `mesh()` to the nearest resolution held. \return OUT_OF_ORDER when nothing is held. O(levels between).
    [[nodiscard]] Status show(std::uint32_t faces);

    /// Whether a base mesh has come.
    [[nodiscard]] bool has_mesh() const { return progressive_.has_value(); }

    /// Faces of the finest resolution held: SetResolutionRequest.faces_held. 0 when nothing is.
    [[nodiscard]] std::uint32_t faces_held() const { return has_mesh() ? held_.faces_max() : 0; }

    /// The mesh shown. \pre has_mesh(). The reference stays valid until begin() or the object's end.
    [[nodiscard]] const TriangleMesh& mesh() const { return progressive_->mesh(); }

    /// All that has come.
    [[nodiscard]] const MultiresMesh& held() const { return held_; }

private:
    [[nodiscard]] Status show_level(std::size_t level);

    std::uint32_t max_faces_;
    MultiresMesh held_;
    std::optional<ProgressiveMesh> progressive_;
};

}  // namespace vsplit::client

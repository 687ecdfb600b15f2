#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "vsplit/base/expected.h"
#include "vsplit/client/call_options.h"
#include "vsplit/mrr/multires_mesh.h"
#include "vsplit/mrr/progressive_mesh.h"
#include "vsplit/mrr/record_codec.h"

namespace vsplit::client {

/// Keeps what Improve, Control and SetResolution stream, and builds the mesh from it at any resolution that has arrived.
///
///     MeshReceiver receiver;
///     auto made = client.improve(request, receiver.handlers());
///     if (made) use(receiver.mesh());
///     if (Status shown = receiver.show(2000); shown) use(receiver.mesh());   // coarser: needs no server
///
/// Everything that comes is checked by ProgressiveMesh before it is kept. Not thread-safe. Memory: that of ProgressiveMesh and
/// of RecordList, of what was held before a keyframe too; once more the mesh shown where it has open boundaries or regions.
class MeshReceiver {
public:
    /// `max_faces`: LIMIT_EXCEEDED when a stream builds more.
    explicit MeshReceiver(std::uint32_t max_faces = 50'000'000) : max_faces_(max_faces) {}

    /// Handlers that feed this object, which must outlive them.
    [[nodiscard]] EventHandlers handlers(std::function<void(const v1::Progress&)> on_progress = {});

    /// Starts anew with a stream's base mesh; with a keyframe what is held is put by. \return what the next returns.
    [[nodiscard]] Status begin(StreamBase base);

    /// The same with one of FLOAT64. \return what ProgressiveMesh::from_base returns, LIMIT_EXCEEDED.
    [[nodiscard]] Status begin(TriangleMesh base, std::uint32_t ghosts = 0);

    /// Adds a block's records and shows them. \return OUT_OF_ORDER when its first record is not the number of records held, that
    /// is also for a block that is repeated or left out; CORRUPT naming the block by its first record; LIMIT_EXCEEDED.
    [[nodiscard]] Status append(const RecordBlock& block);

    /// Adds a part of the regions. \return OUT_OF_ORDER, CORRUPT, LIMIT_EXCEEDED.
    [[nodiscard]] Status take_regions(const v1::Regions& part);

    /// Adds records and shows them; a run may end between two splits. \return OUT_OF_ORDER when `first` is not the number of
    /// records held or no base mesh came before; CORRUPT for a record that does not fit the mesh; LIMIT_EXCEEDED.
    [[nodiscard]] Status append(std::uint32_t first, const RecordSpan& records);

    /// Moves `mesh()` to the nearest resolution held. \return OUT_OF_ORDER when nothing is held. O(records between).
    [[nodiscard]] Status show(std::uint32_t faces);

    /// Whether a base mesh has come.
    [[nodiscard]] bool has_mesh() const { return progressive_.has_value(); }

    /// Faces of the finest resolution held: SetResolutionRequest.faces_held. 0 when nothing is.
    [[nodiscard]] std::uint32_t faces_held() const { return has_mesh() ? held_.faces_max() : 0; }

    /// Number of records held: SetResolutionRequest.resume_from, to go on where a stream broke off.
    [[nodiscard]] std::uint32_t records_held() const { return first_record_ + static_cast<std::uint32_t>(held_.records.size()); }

    /// Whether the regions that stand between a base mesh and its first record are here, or there are none: a record has come, or
    /// whoever reads the stream said with `end_stream` that it is at its end. Else a stream that broke must begin anew.
    [[nodiscard]] bool has_regions() const { return has_regions_; }
    void end_stream() { has_regions_ = has_mesh(); }

    /// Whether what is held begins with a keyframe, a mesh of a finer level, so that `held().faces_min()` is the coarsest there
    /// is.
    [[nodiscard]] bool on_keyframe() const { return first_record_ != 0; }

    /// Gives up the keyframe and all that came after it: held is what was before, which may be nothing. \pre on_keyframe().
    void leave_keyframe();

    /// The mesh shown, without ghosts. \pre has_mesh(). The reference stays valid until begin() or the object's end; its content
    /// is that of the last call. O(1), O(faces) after a change where there are open boundaries.
    [[nodiscard]] const TriangleMesh& mesh() const;

    /// The encoding that what is held came in, and must go on in.
    [[nodiscard]] EncodingChoice encoding() const { return {codec_.grid().encoding(), codec_.grid().bits()}; }

    /// No coordinate differs from the exact one by more; model units.
    [[nodiscard]] double max_error() const { return max_error_; }

    /// All that has come; after a keyframe, that and what came after.
    [[nodiscard]] const MultiresMesh& held() const { return held_; }

private:
    [[nodiscard]] Status show_records(std::size_t records);
    [[nodiscard]] Status check_place(std::uint32_t first);

    std::uint32_t max_faces_;
    RecordCodec codec_;
    double max_error_ = 0;
    MultiresMesh held_;
    std::optional<ProgressiveMesh> progressive_;
    std::uint32_t first_record_ = 0;  // the first of held_.records; not 0 after a keyframe
    bool has_regions_ = false;
    /// What was held before a keyframe.
    struct Before {
        MultiresMesh held;
        std::optional<ProgressiveMesh> progressive;
    };
    Before before_;
    mutable std::optional<std::size_t> visible_records_;  // what visible_ shows; only with ghosts or regions
    mutable TriangleMesh visible_;
};

}  // namespace vsplit::client

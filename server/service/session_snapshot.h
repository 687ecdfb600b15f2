#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "service/method_request.h"
#include "service/representation.h"
#include "service/source_mesh.h"
#include "vsplit/base/expected.h"
#include "vsplit/quality/mesh_quality.h"

namespace vsplit::service {

/// A session at one moment. What the pointers show never changes, so whoever holds a snapshot reads without waiting and goes on
/// reading when the session is gone.
struct SessionSnapshot {
    using RepresentationPointer = std::shared_ptr<const Representation>;

    std::string id;
    std::chrono::system_clock::time_point create_time;
    std::chrono::system_clock::time_point expire_time;
    std::shared_ptr<const SourceMesh> source;            ///< null before an upload
    std::vector<RepresentationPointer> representations;  ///< oldest first
    std::vector<MethodRequest> interrupted;              ///< methods that the end of a server cut off, and nobody asked for since
};

/// \return NOT_FOUND listing the ids there are.
[[nodiscard]] Expected<SessionSnapshot::RepresentationPointer> find_representation(const SessionSnapshot& session,
                                                                                   std::string_view id);

/// \return NOT_READY when the session has none.
[[nodiscard]] Expected<SessionSnapshot::RepresentationPointer> newest_representation(const SessionSnapshot& session);

/// A mesh of a session, built.
struct OpenedMesh {
    MeshRef ref;  ///< which representation, and the resolution that exists
    std::shared_ptr<const TriangleMesh> mesh;
    std::optional<Quality> known_quality;

    /// Heavy unless it is known: O(faces log faces).
    [[nodiscard]] Quality quality() const { return known_quality ? *known_quality : measure_quality(*mesh); }
};

/// One mesh of a session, found but not yet built.
class PickedMesh {
public:
    /// \return NOT_READY before an upload, NOT_FOUND for an unknown representation, INVALID_OPTION (faces) for a resolution of
    /// the upload. O(representations).
    [[nodiscard]] static Expected<PickedMesh> pick(const SessionSnapshot& session, const MeshRef& ref);

    /// Of its lengths. O(1).
    [[nodiscard]] std::optional<LengthUnit> unit() const;

    /// Whether the methods take it. \return what `require_manifold` returns. O(1).
    [[nodiscard]] Status require_accepted() const;

    /// Heavy unless it is in memory: O(records up to it). \return what Kept::get returns.
    [[nodiscard]] Expected<OpenedMesh> open() const;

private:
    [[nodiscard]] Expected<OpenedMesh> open_upload() const;
    [[nodiscard]] Expected<OpenedMesh> open_level() const;

    std::shared_ptr<const SourceMesh> upload_;  // or
    SessionSnapshot::RepresentationPointer representation_;
    std::uint32_t faces_ = 0;  // asked for
};

}  // namespace vsplit::service

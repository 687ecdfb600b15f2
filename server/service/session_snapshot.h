#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "service/method_request.h"
#include "service/representation.h"
#include "service/source_mesh.h"
#include "vsplit/base/expected.h"

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
};

/// \return NOT_FOUND listing the ids there are.
[[nodiscard]] Expected<SessionSnapshot::RepresentationPointer> find_representation(const SessionSnapshot& session,
                                                                                   std::string_view id);

/// \return NOT_READY when the session has none.
[[nodiscard]] Expected<SessionSnapshot::RepresentationPointer> newest_representation(const SessionSnapshot& session);

/// One mesh of a session, found but not yet built.
class PickedMesh {
public:
    /// \return NOT_READY before an upload, NOT_FOUND for an unknown representation.
    [[nodiscard]] static Expected<PickedMesh> pick(const SessionSnapshot& session, const MeshRef& ref);

    /// The mesh that was picked: which representation, and the resolution that exists. O(1).
    [[nodiscard]] MeshRef ref() const;

    [[nodiscard]] std::uint32_t faces() const;

    /// Whether the methods take it. \return what `require_manifold` returns. O(1).
    [[nodiscard]] Status require_accepted() const;

    /// Heavy unless it is the upload or cached: O(level).
    [[nodiscard]] std::shared_ptr<const TriangleMesh> mesh() const;

    /// Heavy unless it is the upload: O(level + faces log faces).
    [[nodiscard]] Quality quality() const;

private:
    std::shared_ptr<const SourceMesh> upload_;  // or
    SessionSnapshot::RepresentationPointer representation_;
    std::size_t level_ = 0;
};

}  // namespace vsplit::service

#pragma once

#include <cstddef>
#include <cstdint>

#include "service/session_snapshot.h"
#include "vsplit/base/expected.h"

namespace vsplit::service {

/// From the resolution a client holds to the one it wants.
struct ResolutionRequest {
    std::string representation;     ///< empty: the session's newest
    std::uint32_t faces_held = 0;   ///< 0: holds nothing
    std::uint32_t faces = 0;        ///< wanted; the nearest that exists is taken
    std::uint32_t resume_from = 0;  ///< number of the first record still missing, also between two splits; 0: all
    bool keyframe = false;          ///< may be given the mesh in place of what lies between; of kFloat64
};

/// What is to be sent for it.
struct ResolutionPlan {
    SessionSnapshot::RepresentationPointer representation;
    std::shared_ptr<const Levels> levels;  ///< its own
    std::size_t level = 0;                 ///< where the client will stand
    bool with_base = false;                ///< the base mesh comes first
    std::size_t first_record = 0;          ///< then records [first_record, last_record)
    std::size_t last_record = 0;
    /// Sent in place of the base mesh: the mesh, ghosts included, that records [0, first_record) lead to. Null: none.
    std::shared_ptr<const TriangleMesh> keyframe{};
};

/// \return NOT_FOUND or NOT_READY (representation).
[[nodiscard]] Expected<SessionSnapshot::RepresentationPointer> find_requested(const SessionSnapshot& session,
                                                                              const ResolutionRequest& request);

/// Heavy unless the representation's levels are in memory, and where a keyframe is made: O(records).
/// \return INVALID_OPTION when `faces_held` is no resolution of it, naming the nearest, or when `resume_from` is beyond its last
/// record; what Kept::get returns. O(log(records)).
[[nodiscard]] Expected<ResolutionPlan> plan_resolution(SessionSnapshot::RepresentationPointer representation,
                                                       const ResolutionRequest& request);

/// All that leads from nothing to a level. O(log(records)).
[[nodiscard]] ResolutionPlan plan_from_nothing(SessionSnapshot::RepresentationPointer representation,
                                               std::shared_ptr<const Levels> levels, std::uint32_t faces);

}  // namespace vsplit::service

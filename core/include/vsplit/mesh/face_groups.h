#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "vsplit/mesh/triangle_mesh.h"

namespace vsplit {

/// Faces that go together: those of a named set, or of a region that no set has.
struct FaceGroup {
    static constexpr std::size_t kRegions = 16;

    std::string name;                    ///< of the set; empty for a region alone
    std::vector<std::uint32_t> regions;  ///< ids: the first kRegions of the set's
    std::uint32_t faces = 0;

    friend bool operator==(const FaceGroup&, const FaceGroup&) = default;
};

/// A mesh's groups, for people to look at: as many as fit on a page or two.
struct FaceGroups {
    static constexpr std::size_t kListed = 100;

    std::vector<FaceGroup> listed{};  ///< the first kListed
    std::uint32_t count = 0;          ///< of all

    friend bool operator==(const FaceGroups&, const FaceGroups&) = default;
};

/// Sets in their order, then regions in no set, by id; none where the mesh has no regions. O(faces log faces).
[[nodiscard]] FaceGroups list_groups(const TriangleMesh& mesh);

}  // namespace vsplit

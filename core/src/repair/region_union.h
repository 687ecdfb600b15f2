#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "vsplit/mesh/triangle_mesh.h"

namespace vsplit {

/// Where copies of a face are dropped, the one that is kept goes into their sets too. A face has one region, so that the sets of
/// several are a region of their own.
class RegionUnion {
public:
    /// \pre `mesh` has regions and outlives this. O(faces log faces + members of sets).
    explicit RegionUnion(TriangleMesh& mesh);

    struct Joined {
        std::uint32_t region = 0;  ///< for the face that is kept; the mesh's sets have it where it is new
        bool loses = false;        ///< a region in no set has no more than its id, of which a face has one: `lost` is given up
        std::uint32_t lost = 0;
    };
    /// What becomes of a face of region `kept` when a copy of region `dropped` goes. Sets come before a region in no set.
    /// O(log regions + sets of both).
    [[nodiscard]] Joined join(std::uint32_t kept, std::uint32_t dropped);

    /// Whether faces of it are in no group at all: there is nothing to lose.
    [[nodiscard]] bool is_no_group(std::uint32_t region) const { return region == 0 && sets_of(region).empty(); }

    /// For people: "region 7", or "'skin', 'top'" by the sets it is in.
    [[nodiscard]] std::string label(std::uint32_t region) const;

private:
    using Sets = std::vector<std::uint32_t>;  // their places in the mesh's, ascending

    [[nodiscard]] const Sets& sets_of(std::uint32_t region) const;

    TriangleMesh& mesh_;
    std::map<std::uint32_t, Sets> sets_of_;
    std::map<Sets, std::uint32_t> region_of_;
    std::set<std::uint32_t> taken_;  // numbers of regions
};

}  // namespace vsplit

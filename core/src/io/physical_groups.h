#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "vsplit/mesh/triangle_mesh.h"

namespace vsplit {

/// Gmsh's physical groups of surfaces, of which a face may be in several. Regions do not overlap, so that each combination of
/// groups is a region, and a group the set of those it is in.
class PhysicalGroups {
public:
    /// What a group is called.
    void name(std::uint32_t group, std::string name) { names_[group] = std::move(name); }

    /// The number of a combination, until `apply`: 0 where there is none. Groups that come twice count once. O(groups log all).
    [[nodiscard]] std::uint32_t combination(std::span<const std::uint32_t> groups);

    /// Regions of faces, which are combinations, become numbers of groups: of the one group where it is one, of the first that no
    /// other combination has where there are several, else a number that no group has. Groups with a name are sets, as are those
    /// without one (`physical_7`) that are no region of their own. O(faces + combinations * groups).
    void apply(TriangleMesh& mesh) const;

private:
    [[nodiscard]] std::vector<std::uint32_t> numbers(std::span<const std::uint32_t> used) const;

    std::map<std::uint32_t, std::string> names_;
    std::map<std::vector<std::uint32_t>, std::uint32_t> numbers_;  // of combinations, by their groups in ascending order
    std::vector<std::vector<std::uint32_t>> combinations_{{}};     // as they came
};

}  // namespace vsplit

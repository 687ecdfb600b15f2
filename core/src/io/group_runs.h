#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "vsplit/mesh/triangle_mesh.h"

namespace vsplit {

/// Names that a file gives to the faces that follow, up to the next names: OBJ's groups, of which faces may be in several, STL's
/// solids.
class GroupRuns {
public:
    /// What one group that holds all faces is. OBJ names groups only where there are some; an STL always names its solid.
    enum class Lone { kIsGroup, kIsNone };

    /// From face `first_face` on faces are in the groups `names`, which may have been given before; empty names are none.
    void begin(std::span<const std::string_view> names, std::uint32_t first_face);

    /// Faces that are in the same groups become a region, numbered from 1 in order of their first; 0 are those in none. Each
    /// group that has faces becomes a set. Nothing where all faces are in none.
    void give_to(TriangleMesh& mesh, Lone lone) const;

private:
    using Groups = std::vector<std::uint32_t>;  // numbers of names, ascending

    struct Run {
        std::uint32_t groups = 0;  // in groups_
        std::uint32_t first_face = 0;
    };
    std::map<std::string, std::uint32_t, std::less<>> names_;
    std::map<Groups, std::uint32_t> groups_;
    std::vector<Run> runs_;
};

}  // namespace vsplit

#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "vsplit/mesh/triangle_mesh.h"

namespace vsplit {

/// Names that a file gives to the faces that follow, up to the next name: OBJ's groups, STL's solids.
class GroupRuns {
public:
    /// From face `first_face` on faces are in `name`, which may have been given before.
    void begin(std::string_view name, std::uint32_t first_face) { runs_.push_back({name, first_face}); }

    /// Numbers the groups that have faces from 1 in order of their first; nothing where all faces are in one, or in none.
    /// Faces before the first name, and those in a group without a name, are in region 0.
    void give_to(TriangleMesh& mesh) const;

private:
    struct Run {
        std::string_view name;
        std::uint32_t first_face = 0;
    };
    std::vector<Run> runs_;
};

}  // namespace vsplit

#pragma once

namespace vsplit {

/// How creases are told from the rest of a surface. DIHEDRAL looks at the two faces of an edge and suits CAD and FE meshes;
/// NORMAL_VOTING asks the whole neighbourhood and suits scans, where noise makes every edge look sharp.
enum class FeatureDetection { kDihedral, kNormalVoting };

}  // namespace vsplit

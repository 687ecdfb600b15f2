#include "vsplit/mrr/multires_mesh.h"

#include <algorithm>

namespace vsplit {

std::size_t MultiresMesh::level_for(std::uint32_t faces) const {
    if (faces <= base.face_count()) return 0;
    return std::min<std::size_t>((faces - base.face_count()) / 2, splits.size());
}

}  // namespace vsplit

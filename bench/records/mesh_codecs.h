#pragma once

#include <string>
#include <string_view>

#include "vsplit/mesh/triangle_mesh.h"

/// Other people's codecs of one mesh, positions on a grid of 14 bits, from an indexed mesh in memory to bytes and back. What they
/// give back is the mesh in their own order of vertices and faces. They end the program where they fail.
namespace vsplit::bench {

[[nodiscard]] std::string encode_draco(const TriangleMesh& mesh);
[[nodiscard]] TriangleMesh decode_draco(std::string_view bytes);

/// Its codecs of vertex and index buffers alone, positions as 16-bit numbers of which 14 bits are used, ordered for it first; in
/// front of them what a reader must know: counts and the grid.
[[nodiscard]] std::string encode_meshoptimizer(const TriangleMesh& mesh);
[[nodiscard]] TriangleMesh decode_meshoptimizer(std::string_view bytes);

}  // namespace vsplit::bench

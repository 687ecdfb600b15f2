#pragma once

#include <string>

#include "vsplit/mesh/triangle_mesh.h"

namespace vsplit {

/// One writer a format; see write_mesh.

[[nodiscard]] std::string write_stl_binary(const TriangleMesh& mesh);
[[nodiscard]] std::string write_stl_ascii(const TriangleMesh& mesh);
[[nodiscard]] std::string write_obj(const TriangleMesh& mesh);
[[nodiscard]] std::string write_ply_binary(const TriangleMesh& mesh);
[[nodiscard]] std::string write_ply_ascii(const TriangleMesh& mesh);
[[nodiscard]] std::string write_off(const TriangleMesh& mesh);

}  // namespace vsplit

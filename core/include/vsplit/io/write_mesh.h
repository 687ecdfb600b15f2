#pragma once

#include <filesystem>
#include <string>

#include "vsplit/base/expected.h"
#include "vsplit/io/mesh_format.h"
#include "vsplit/mesh/triangle_mesh.h"

namespace vsplit {

/// The bytes of a mesh file. STL holds single precision (the format knows no other); BDF
/// 11 digits or more; all others keep doubles exactly
/// (shortest text that reads back equal; PLY properties of type double). The same mesh gives the same bytes, always.
/// O(faces) time; memory: the file.
[[nodiscard]] std::string write_mesh(const TriangleMesh& mesh, MeshFormat format);

/// Writes to `path` beside itself and renames, so that no half-written file is ever seen. FILE_ACCESS on failure.
[[nodiscard]] Status write_mesh_file(const TriangleMesh& mesh, MeshFormat format, const std::filesystem::path& path);

}  // namespace vsplit

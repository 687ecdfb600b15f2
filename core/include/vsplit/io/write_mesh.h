#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "vsplit/base/expected.h"
#include "vsplit/io/mesh_format.h"
#include "vsplit/mesh/length_unit.h"
#include "vsplit/mesh/triangle_mesh.h"

namespace vsplit {

/// The bytes of a mesh file. STL holds single precision (the format knows no other); BDF
/// 11 digits or more; all others keep doubles exactly
/// (shortest text that reads back equal; PLY properties of type double). The same mesh gives the same bytes, always.
/// `unit`: of the coordinates, which are written as they are; only 3MF says it, and without it is read as millimetres (see
/// check_unit). O(faces) time; memory: the file.
[[nodiscard]] std::string write_mesh(const TriangleMesh& mesh, MeshFormat format, std::optional<LengthUnit> unit = {});

/// Whether a mesh in `unit` can be written in that format with its lengths converted to `asked`, where that is given.
/// \return INVALID_OPTION (field "unit") where the mesh's unit is not known: nothing can be converted, and 3MF has to say it.
[[nodiscard]] Status check_unit(MeshFormat format, std::optional<LengthUnit> unit, std::optional<LengthUnit> asked);

/// Writes to `path` beside itself and renames, so that no half-written file is ever seen. FILE_ACCESS on failure.
[[nodiscard]] Status write_mesh_file(const TriangleMesh& mesh, MeshFormat format, const std::filesystem::path& path,
                                     std::optional<LengthUnit> unit = {});

}  // namespace vsplit

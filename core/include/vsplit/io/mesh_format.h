#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

#include "vsplit/base/expected.h"

namespace vsplit {

/// Mesh files that are read and written. Reading tells the kinds of STL, PLY, MSH and VTK apart by the bytes.
enum class MeshFormat {
    kStlBinary,
    kStlAscii,
    kObj,
    kPlyBinary,  ///< little-endian when written; both byte orders are read
    kPlyAscii,
    kOff,
    kMsh,        ///< Gmsh 4.1, bytes when written; 4.1 and 2.2 are read, text and bytes
    kMshAscii,   ///< Gmsh 4.1 as text
    kMsh2,       ///< Gmsh 2.2, bytes
    kMsh2Ascii,  ///< Gmsh 2.2 as text
    kInp,        ///< input deck of Abaqus and CalculiX
    kBdf,        ///< Nastran bulk data
    kVtk,        ///< legacy VTK, bytes
    kVtkAscii,   ///< legacy VTK as text
    kVtu,        ///< VTK's XML for unstructured grids
    k3mf,        ///< 3D Manufacturing Format: XML in a zip archive; the one that says its unit
};

/// All of them.
[[nodiscard]] std::span<const MeshFormat> mesh_formats();

/// "stl", "stl-ascii", "obj", "ply", "ply-ascii", "off", "msh", "msh-ascii", "msh2", "msh2-ascii", "inp", "bdf", "vtk",
/// "vtk-ascii", "vtu", "3mf".
[[nodiscard]] std::string_view format_name(MeshFormat format);

/// The inverse of format_name. \return INVALID_OPTION listing the names.
[[nodiscard]] Expected<MeshFormat> format_by_name(std::string_view name);

/// By the extension of a file's name (".stl" is binary), in any case. \return UNKNOWN_FORMAT listing the extensions.
[[nodiscard]] Expected<MeshFormat> format_by_extension(std::string_view file_name);

/// By the bytes themselves; a binary STL whose header begins with "solid" is told by its length. A few odd bytes do not make a
/// text a binary file.
/// Empty when no format fits. O(1): looks at the first few KiB and the length, and past comments for a MiB at most.
[[nodiscard]] std::optional<MeshFormat> detect_format(std::span<const std::byte> bytes);

/// What to read a file as whose bytes do not tell it: by its name, among the formats that have no mark of their own (OBJ, OFF,
/// INP, BDF). Empty where the bytes tell it, or the name does not either. Complexity: as detect_format.
[[nodiscard]] std::optional<MeshFormat> format_where_bytes_do_not_tell(std::span<const std::byte> bytes,
                                                                       std::string_view file_name);

}  // namespace vsplit

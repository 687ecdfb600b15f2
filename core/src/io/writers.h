#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "vsplit/mesh/length_unit.h"
#include "vsplit/mesh/triangle_mesh.h"

namespace vsplit {

class Elements;

/// One writer a format; see write_mesh.

[[nodiscard]] std::string write_stl_binary(const TriangleMesh& mesh);
[[nodiscard]] std::string write_stl_ascii(const TriangleMesh& mesh);
[[nodiscard]] std::string write_obj(const TriangleMesh& mesh);
[[nodiscard]] std::string write_ply_binary(const TriangleMesh& mesh);
[[nodiscard]] std::string write_ply_ascii(const TriangleMesh& mesh);
[[nodiscard]] std::string write_off(const TriangleMesh& mesh);
[[nodiscard]] std::string write_msh_4(const Elements& elements, bool text);
[[nodiscard]] std::string write_msh_2(const Elements& elements, bool text);
[[nodiscard]] std::string write_inp(const Elements& elements);
[[nodiscard]] std::string write_bdf(const Elements& elements);
[[nodiscard]] std::string write_vtk(const Elements& elements, bool text);
[[nodiscard]] std::string write_vtu(const Elements& elements);
[[nodiscard]] std::string write_3mf(const TriangleMesh& mesh, std::optional<LengthUnit> unit);

/// The set of all elements in an input deck; a reader makes no region of it.
inline constexpr std::string_view kAllElements = "Eall";
/// What an input deck's surface is called of which a set of elements is one side: the set's name with this behind it.
inline constexpr std::string_view kSurfaceSuffix = "_surface";

}  // namespace vsplit

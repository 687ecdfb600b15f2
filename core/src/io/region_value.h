#pragma once

#include <cstdint>
#include <string_view>

#include "io/read_error.h"
#include "vsplit/base/expected.h"

namespace vsplit {

/// Whether an array of this name, of cells or faces, says which region each is in: "region", "regions", "region_id", "group",
/// "PhysicalIds", "gmsh:physical", "CellEntityIds", "label", "material_id" and the like, in any case.
[[nodiscard]] bool is_region_name(std::string_view name);

/// The region that a number of such an array is; negative ones are how Gmsh and others say that there is none.
/// \return MALFORMED_INPUT for what is no integer up to 2^32 - 2.
[[nodiscard]] Expected<std::uint32_t> region_of(double value, Place place);

}  // namespace vsplit

#include "io/region_value.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "io/text_lines.h"

namespace vsplit {

bool is_region_name(std::string_view name) {
    constexpr std::array<std::string_view, 14> kNames = {
        "region", "regions",       "region_id",     "regionid",    "group",       "group_id", "physicalids",
        "label",  "gmsh:physical", "cellentityids", "material_id", "materialids", "face_id",  "pid"};
    return std::any_of(kNames.begin(), kNames.end(), [&](std::string_view known) { return equals_ignoring_case(known, name); });
}

Expected<std::uint32_t> region_of(double value, Place place) {
    constexpr double kLargest = 4294967294;
    if (value < 0 && value == std::trunc(value)) return 0U;
    if (value >= 0 && value <= kLargest && value == std::trunc(value)) return static_cast<std::uint32_t>(value);
    return read_error(Cause::kMalformedInput, place, "expected a region, an integer up to 4294967294, found " + to_text(value));
}

}  // namespace vsplit

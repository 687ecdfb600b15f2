#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "vsplit/base/expected.h"
#include "vsplit/mesh/triangle_mesh.h"

namespace vsplit {

/// What a mesh's coordinates, and all lengths about it, are given in. Where nobody knows there is none: an empty optional.
enum class LengthUnit { kMicrometre, kMillimetre, kCentimetre, kMetre, kInch, kFoot };

/// All of them.
[[nodiscard]] std::span<const LengthUnit> length_units();

/// "um", "mm", "cm", "m", "in", "ft".
[[nodiscard]] std::string_view unit_symbol(LengthUnit unit);

/// The inverse of unit_symbol. \return INVALID_OPTION (field "unit") listing the symbols.
[[nodiscard]] Expected<LengthUnit> unit_by_symbol(std::string_view symbol);

/// The unit that both speak of: what a file tells of itself, and what its user states. \return INVALID_OPTION (field "unit") with
/// both where they do not agree.
[[nodiscard]] Expected<std::optional<LengthUnit>> agreed_unit(std::optional<LengthUnit> told, std::optional<LengthUnit> stated);

/// Metres in one unit; exact to the last bit.
[[nodiscard]] double metres_in(LengthUnit unit);

/// Lengths, or the coordinates of positions, in `from` become those in `to`: multiplied and divided by small whole numbers, so
/// that 1 in is 25.4 mm and nothing is rounded that need not be. O(positions).
void convert_lengths(std::span<Vec3> positions, LengthUnit from, LengthUnit to);

}  // namespace vsplit

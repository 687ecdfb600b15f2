#include "io/inp_elements.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

#include "io/text_lines.h"

namespace vsplit {
namespace {

/// A type is a family, a number of nodes and letters for what it can do: S|4|R5, CPS|6|M, M3D|9|R.
using Families = std::span<const std::string_view>;

/// Shells, membranes, surfaces, rigid faces; then what is meshed in a plane: plane stress and strain, axisymmetric.
constexpr std::array<std::string_view, 20> kFaces = {"S",     "DS",    "US",   "STRI", "M3D",   "SFM3D", "R3D",
                                                     "CPS",   "CPE",   "CPEG", "CAX",  "CGAX",  "DC2D",  "DCAX",
                                                     "DCC2D", "DCCAX", "AC2D", "ACAX", "EMC2D", "WARP2D"};

/// Continuum shells (SC, CSS) among them: bricks and wedges as thick as the shell.
constexpr std::array<std::string_view, 8> kSolids = {"C3D", "DC3D", "DCC3D", "AC3D", "EC3D", "Q3D", "SC", "CSS"};

/// What has no face, or none that is counted: beams, trusses, springs, masses, connectors, contact, particles; solids whose
/// number of nodes varies.
constexpr std::array<std::string_view, 50> kWithoutFace = {
    "C3D15V", "C3D27", "CCL",  "COH3D", "CIN3D", "GK3D",   "EMC3D", "PC3D",    "PD3D",    "B2",      "B3",   "PIPE", "ELBOW",
    "FRAME",  "T2D",   "T3D",  "MASS",  "ITS",   "SPRING", "CONN",  "DASHPOT", "ROTARYI", "HEATCAP", "GAP",  "DGAP", "ITT",
    "DCOUP",  "JOINT", "LS3S", "LS6",   "PSI2",  "PSI3",   "ISL",   "IRS",     "DC1D",    "DCC1D",   "AC1D", "R2D2", "RAX2",
    "RB2D",   "RB3D",  "SAX",  "DSAX",  "MAX",   "MGAX",   "SFMAX", "SFMGAX",  "FLINK",   "FAX",     "TUBE"};

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// The number behind the one of the families that `type` is of; empty where it is of none.
std::optional<std::int64_t> nodes_of(std::string_view type, Families families) {
    for (const std::string_view family : families) {
        if (!type.starts_with(family) || type.size() == family.size() || !is_digit(type[family.size()])) continue;
        const std::string_view rest = type.substr(family.size());
        const auto end = std::find_if_not(rest.begin(), rest.end(), is_digit);
        return parse_integer(rest.substr(0, static_cast<std::size_t>(end - rest.begin())));
    }
    return {};
}

/// Corners come first, then the middles of the sides and of the face.
std::size_t corners_of(std::int64_t nodes) {
    if (nodes == 3 || nodes == 6) return 3;
    return nodes == 4 || nodes == 8 || nodes == 9 ? 4 : 0;
}

}  // namespace

std::optional<InpElement> inp_element(std::string_view type) {
    if (type == "STRI65") return InpElement{6, 3};  // six nodes of five freedoms each
    if (const auto nodes = nodes_of(type, kFaces); nodes && corners_of(*nodes) != 0)
        return InpElement{static_cast<std::size_t>(*nodes), corners_of(*nodes)};
    const auto begins_type = [&](std::string_view family) { return type.starts_with(family); };
    if (type == "D" || std::any_of(kWithoutFace.begin(), kWithoutFace.end(), begins_type)) return InpElement{};
    constexpr std::int64_t kMostNodes = 32;
    if (const auto nodes = nodes_of(type, kSolids); nodes && *nodes >= 4 && *nodes <= kMostNodes)
        return InpElement{static_cast<std::size_t>(*nodes), 0};
    return {};
}

}  // namespace vsplit

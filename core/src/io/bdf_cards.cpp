#include "io/bdf_cards.h"

#include <algorithm>
#include <array>
#include <span>

namespace vsplit {
namespace {

using Names = std::span<const std::string_view>;

/// Shells, and what is meshed in a plane: axisymmetric, plane strain and stress.
constexpr std::array<std::string_view, 10> kTriangles = {"CTRIA3", "CTRIA6",  "CTRIAR",  "CTRIAX",  "CTRAX3",
                                                         "CTRAX6", "CPLSTN3", "CPLSTN6", "CPLSTS3", "CPLSTS6"};
constexpr std::array<std::string_view, 13> kQuadrilaterals = {"CQUAD4",  "CQUAD8",  "CQUAD9",  "CQUADR",  "CQUAD",
                                                              "CSHEAR",  "CQUADX",  "CQUADX4", "CQUADX8", "CPLSTN4",
                                                              "CPLSTN8", "CPLSTS4", "CPLSTS8"};
constexpr std::array<std::string_view, 7> kSolids = {"CTETRA", "CHEXA", "CPENTA", "CPYRAM", "CHEXCZ", "CPENTCZ", "CIHEX"};

/// How the names of other cards begin: beams, rods, springs, dampers, masses, gaps, welds, what lies on the faces of others
/// (heat, absorbers); systems of coordinates, sets, contact, aerodynamics.
constexpr std::array<std::string_view, 57> kWithoutFace = {
    "CBUTT",  "CDSMETH", "CMSMETH", "CNTSTB",  "CONTPRM", "CSPOT",  "CSPR",   "CAABSF", "CAERO",   "CAMPBLL", "CAXIF",   "CBAR",
    "CBEAM",  "CBEND",   "CBUSH",   "CCONEAX", "CCRSFIL", "CDAMP",  "CDUM",   "CELAS",  "CFAST",   "CFLUID",  "CFILLET", "CGAP",
    "CGEN",   "CHAC",    "CHBDY",   "CIFHEX",  "CIFPENT", "CINTC",  "CLOAD",  "CMASS",  "CMREBAI", "CMREBAR", "CNGRET",  "CONCTL",
    "CONM",   "CONROD",  "CONTACT", "CONTRLT", "CONV",    "CORD",   "CRAC3D", "CREEP",  "CROD",    "CSEAM",   "CSET",    "CSLOT",
    "CSSCHD", "CSUP",    "CTUBE",   "CVISC",   "CWELD",   "CWSEAM", "CYAX",   "CYJOIN", "CYSYM"};

bool is_one_of(std::string_view name, Names names) { return std::find(names.begin(), names.end(), name) != names.end(); }

bool begins_with_one_of(std::string_view name, Names names) {
    return std::any_of(names.begin(), names.end(), [&](std::string_view begin) { return name.starts_with(begin); });
}

}  // namespace

BdfCard bdf_card(std::string_view name) {
    using Kind = BdfCard::Kind;
    if (!name.starts_with('C')) return {};
    if (name == "CTRIAX6") return {Kind::kFace, 3, 2};  // corners and middles in turn
    if (is_one_of(name, kTriangles)) return {Kind::kFace, 3, 1};
    if (is_one_of(name, kQuadrilaterals)) return {Kind::kFace, 4, 1};
    if (begins_with_one_of(name, kSolids)) return {Kind::kSolid};
    return {begins_with_one_of(name, kWithoutFace) ? Kind::kOther : Kind::kUnknown};
}

}  // namespace vsplit

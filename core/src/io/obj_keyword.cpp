#include "io/obj_keyword.h"

#include <algorithm>
#include <array>

namespace vsplit {
namespace {

/// Keywords of what makes no face, or is only told of the faces: Wavefront's format 3.0 and its older statements. Those of curves
/// and free-form surfaces count where a `surf` uses them.
constexpr auto kPassedOver = std::to_array<std::string_view>(
    {"vn",   "vt",    "vp",       "o",        "s",          "l",         "p",     "mg",    "mtllib", "usemtl", "usemap", "maplib",
     "lod",  "bevel", "c_interp", "d_interp", "shadow_obj", "trace_obj", "ctech", "stech", "cstype", "deg",    "bmat",   "step",
     "parm", "trim",  "hole",     "scrv",     "sp",         "end",       "con",   "curv",  "curv2",  "res",    "cdc",    "cdp"});

/// Keywords of what makes surface that is not read.
constexpr auto kNotRead = std::to_array<std::string_view>({"surf", "call", "csh", "bsp", "bzp"});

}  // namespace

std::optional<ObjLine> obj_line(std::string_view keyword) {
    if (keyword == "v") return ObjLine::kVertex;
    if (keyword == "f" || keyword == "fo") return ObjLine::kFace;  // "fo" is how old files spell it
    if (keyword == "g") return ObjLine::kGroup;
    const auto is_one_of = [&](const auto& words) { return std::find(words.begin(), words.end(), keyword) != words.end(); };
    if (is_one_of(kPassedOver)) return ObjLine::kPassedOver;
    return is_one_of(kNotRead) ? std::optional(ObjLine::kNotRead) : std::nullopt;
}

}  // namespace vsplit

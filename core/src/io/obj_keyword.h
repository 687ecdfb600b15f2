#pragma once

#include <optional>
#include <string_view>

namespace vsplit {

/// What a line of an OBJ is to a surface.
enum class ObjLine {
    kVertex,
    kFace,
    kGroup,
    kPassedOver,  ///< makes no face
    kNotRead,     ///< makes surface that is not read
};

/// By the keyword it begins with: those of Wavefront's format 3.0 and its older statements, in lower case. Empty for a word that
/// is none.
[[nodiscard]] std::optional<ObjLine> obj_line(std::string_view keyword);

}  // namespace vsplit

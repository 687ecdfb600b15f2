#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

namespace vsplit {

/// What an element of an input deck is to a surface.
struct InpElement {
    std::size_t nodes = 0;    ///< 0: it is passed over unread
    std::size_t corners = 0;  ///< the first of its nodes; 0: it is no face

    [[nodiscard]] bool is_face() const { return corners != 0; }
};

/// A type as Abaqus and CalculiX name them, in upper case: "S3R", "STRI65", "C3D10". Empty for one that is not known, which could
/// be a face.
[[nodiscard]] std::optional<InpElement> inp_element(std::string_view type);

}  // namespace vsplit

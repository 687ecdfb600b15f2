#pragma once

#include <cstddef>
#include <string_view>

namespace vsplit {

/// What a card of Nastran's bulk data is to a surface.
struct BdfCard {
    enum class Kind {
        kOther,  ///< nothing
        kFace,
        kSolid,
        kUnknown,  ///< its name begins as an element's does
    };
    Kind kind = Kind::kOther;
    std::size_t corners = 0;  ///< of a face, from field 4 on
    std::size_t step = 1;     ///< every how many nodes a corner comes
};

/// By a card's name in upper case. O(number of names).
[[nodiscard]] BdfCard bdf_card(std::string_view name);

}  // namespace vsplit

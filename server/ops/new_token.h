#pragma once

#include <string>
#include <string_view>

#include "vsplit/base/expected.h"

namespace vsplit::ops {

/// A token that was just made.
struct NewToken {
    std::string token;  ///< for whoever is to have it; kept nowhere
    std::string line;   ///< for the file of --token-file
};

/// `request` is NAME:read-only or NAME:read-write. \return INVALID_OPTION, INTERNAL without randomness.
[[nodiscard]] Expected<NewToken> make_token(std::string_view request);

}  // namespace vsplit::ops

#pragma once

#include <optional>

#include "method/prepare.h"

namespace vsplit {

/// What a run of either method needs beside its policy.
struct MethodRun {
    PrepareOptions prepare;
    bool extended = false;
    double max_deviation = 0;       ///< as used; extended mode only
    std::optional<double> limit{};  ///< max_deviation where it was given: kept at the price of faces
};

}  // namespace vsplit

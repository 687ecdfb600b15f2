#pragma once

#include "simplify/crease_guard.h"
#include "simplify/deviation_guard.h"

namespace vsplit {

/// What has a say in every change of the mesh; either may be null.
struct Guards {
    DeviationGuard* surface = nullptr;
    CreaseGuard* creases = nullptr;
};

}  // namespace vsplit

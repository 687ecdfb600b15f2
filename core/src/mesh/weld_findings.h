#pragma once

#include <vector>

#include "vsplit/mesh/finding.h"
#include "vsplit/mesh/weld.h"

namespace vsplit {

/// What a weld changed that is worth a word: not that equal vertices became one.
[[nodiscard]] std::vector<Finding> weld_findings(const WeldCounts& weld);

}  // namespace vsplit

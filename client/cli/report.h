#pragma once

#include <string>
#include <vector>

#include "cli/outcome.h"

namespace vsplit::cli {

/// The document as a short, aligned table for people; `detailed` adds the histogram of stretch and the worst faces.
[[nodiscard]] std::string report(const Document& document, bool detailed);

/// A line for each file that was written.
[[nodiscard]] std::string written_lines(const std::vector<std::string>& files);

}  // namespace vsplit::cli

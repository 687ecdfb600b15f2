#pragma once

#include <string>
#include <utility>
#include <vector>

namespace vsplit::rest {

/// Fields of an HTTP header, in order.
using HeaderFields = std::vector<std::pair<std::string, std::string>>;

}  // namespace vsplit::rest

#pragma once

#include <functional>
#include <string>

namespace vsplit::store {

/// Hears of what an operator should know. Any thread; must not block.
using Report = std::function<void(const std::string& message)>;

}  // namespace vsplit::store

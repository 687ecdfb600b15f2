#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "service/caller.h"
#include "vsplit/base/error.h"

namespace vsplit::service {

/// One method that a worker was at, or one removal of features.
struct JobRecord {
    std::string_view method;  ///< "Improve", "Control" or "RemoveFeatures"
    std::string session{};
    CallMark mark{};     ///< of the call that asked for it
    double waited = 0;   ///< seconds between the call and the worker
    double seconds = 0;  ///< of the worker
    std::uint32_t faces_in = 0;
    std::uint32_t faces_out = 0;     ///< 0 where it failed
    std::optional<Cause> outcome{};  ///< empty: it succeeded
};

/// Hears of every such method at its end, on the worker's thread. Must not block.
using JobObserver = std::function<void(const JobRecord&)>;

}  // namespace vsplit::service

#pragma once

#include <optional>

#include "simplify/crease_guard.h"
#include "simplify/deviation_guard.h"

namespace vsplit {

/// What has a say in every change of the mesh; either may be null.
struct Guards {
    DeviationGuard* surface = nullptr;
    CreaseGuard* creases = nullptr;
};

/// Copies of guards, for a thread of its own.
class OwnGuards {
public:
    explicit OwnGuards(const Guards& guards) {
        if (guards.surface != nullptr) surface_.emplace(*guards.surface);
        if (guards.creases != nullptr) creases_.emplace(*guards.creases);
    }
    [[nodiscard]] Guards all() { return {surface_ ? &*surface_ : nullptr, creases_ ? &*creases_ : nullptr}; }

private:
    std::optional<DeviationGuard> surface_;
    std::optional<CreaseGuard> creases_;
};

}  // namespace vsplit

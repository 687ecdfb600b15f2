#pragma once

#include <cstdint>
#include <initializer_list>
#include <vector>

#include "simplify/deviation_guard.h"
#include "simplify/fan.h"

namespace vsplit {

/// A fan as faces for a DeviationGuard; owns the scratch memory.
class FanReplacement {
public:
    /// Whether the guard lets the fan stand with its vertex at `apex`, where its faces and those of `vanishing` were. `ends` are
    /// the vertices that it becomes the fan of; only an open one needs them.
    [[nodiscard]] bool try_on(DeviationGuard& guard, const Fan& fan, const Vec3& apex,
                              std::initializer_list<std::uint32_t> vanishing, const BorderGuard::Ends& ends = {}) {
        BorderGuard* const border = fan.is_open() ? guard.border() : nullptr;
        if (border != nullptr && !border->admits(fan, apex, ends)) return false;
        old_.assign(vanishing);
        new_.clear();
        for (std::size_t t = 0; t < fan.size(); ++t) {
            old_.push_back(fan.face(t));
            new_.push_back({fan.face(t), apex, fan.ring(t), fan.ring(t + 1), fan.old_normal(t)});
        }
        if (!guard.replace(old_, new_)) return false;
        if (border != nullptr) border->commit();
        return true;
    }

private:
    std::vector<std::uint32_t> old_;
    std::vector<DeviationGuard::NewFace> new_;
};

}  // namespace vsplit

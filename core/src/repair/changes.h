#pragma once

#include <cstdint>
#include <map>
#include <string_view>
#include <vector>

#include "vsplit/mesh/finding.h"

namespace vsplit {

/// Collects what a repair changes, by kind.
class Changes {
public:
    /// One change at `place`; `face` is a face of the input, or kNoFace.
    void add(Finding::Kind kind, const Vec3& place, std::uint32_t face = kNoFace);

    /// A finding a kind, in the order of the enumeration, with a sentence.
    [[nodiscard]] std::vector<Finding> take();

    static constexpr std::uint32_t kNoFace = 0xFFFFFFFFU;

private:
    std::map<Finding::Kind, Finding> findings_;
};

}  // namespace vsplit

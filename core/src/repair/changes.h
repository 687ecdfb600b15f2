#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "vsplit/mesh/finding.h"

namespace vsplit {

/// Collects what a repair changes, by kind.
class Changes {
public:
    /// One change at `place`; `face` is a face of the input, or kNoFace.
    void add(Finding::Kind kind, const Vec3& place, std::uint32_t face = kNoFace);

    /// Faces that `of` lost, a region or sets in words; the finding's sentence tells them.
    void add_loss(Finding::Kind kind, const Vec3& place, std::uint32_t face, const std::string& of, std::uint32_t faces = 1);

    /// A finding a kind, in the order of the enumeration, with a sentence.
    [[nodiscard]] std::vector<Finding> take();

    static constexpr std::uint32_t kNoFace = 0xFFFFFFFFU;

private:
    std::map<Finding::Kind, Finding> findings_;
    std::map<Finding::Kind, std::map<std::string, std::uint32_t>> losses_;  // faces, by what lost them
};

}  // namespace vsplit

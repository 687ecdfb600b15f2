#pragma once

#include <bit>
#include <cstdint>
#include <vector>

namespace vsplit::web {

/// A set of numbers near 0, a bit each.
class Marks {
public:
    void add(std::uint32_t number) {
        if (number / kBits >= words_.size()) words_.resize(number / kBits + 1);
        words_[number / kBits] |= std::uint64_t{1} << number % kBits;
    }

    /// Those in it in ascending order, which then are no longer. O(the largest).
    template <class Visit>
    void take(Visit visit) {
        for (std::uint32_t at = 0; at < words_.size(); ++at) {
            for (; words_[at] != 0; words_[at] &= words_[at] - 1)
                visit(at * kBits + static_cast<std::uint32_t>(std::countr_zero(words_[at])));
        }
    }

private:
    static constexpr std::uint32_t kBits = 64;
    std::vector<std::uint64_t> words_;
};

}  // namespace vsplit::web

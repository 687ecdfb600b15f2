#pragma once

#include <cstddef>

// What core uses of TBB, for a target without threads: one after the other.
namespace tbb {

template <class Value>
class blocked_range {
public:
    blocked_range(Value begin, Value end, std::size_t /*grain*/ = 1) : begin_(begin), end_(end) {}
    [[nodiscard]] Value begin() const { return begin_; }
    [[nodiscard]] Value end() const { return end_; }

private:
    Value begin_, end_;
};

}  // namespace tbb

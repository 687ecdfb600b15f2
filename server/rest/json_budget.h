#pragma once

#include <cstdint>
#include <mutex>
#include <utility>

namespace vsplit::rest {

/// Memory that all bodies which are held at a time share. Thread-safe.
class JsonBudget {
public:
    explicit JsonBudget(std::uint64_t bytes) : left_(bytes) {}

    [[nodiscard]] bool take(std::uint64_t bytes) {
        const std::lock_guard lock(mutex_);
        if (bytes > left_) return false;
        left_ -= bytes;
        return true;
    }

    void give_back(std::uint64_t bytes) {
        const std::lock_guard lock(mutex_);
        left_ += bytes;
    }

private:
    std::mutex mutex_;
    std::uint64_t left_;
};

/// A share of the budget, which grows with what is held and is given back at the end of the scope.
class JsonShare {
public:
    explicit JsonShare(JsonBudget& budget) : budget_(&budget) {}
    JsonShare(JsonShare&& other) noexcept : budget_(other.budget_), held_(std::exchange(other.held_, 0)) {}
    JsonShare(const JsonShare&) = delete;
    JsonShare& operator=(const JsonShare&) = delete;
    JsonShare& operator=(JsonShare&&) = delete;
    ~JsonShare() { budget_->give_back(held_); }

    /// Holds so many bytes in all from now on, never fewer than before; false where the budget has not so many left.
    [[nodiscard]] bool hold(std::uint64_t bytes) {
        if (bytes <= held_) return true;
        if (!budget_->take(bytes - held_)) return false;
        held_ = bytes;
        return true;
    }

private:
    JsonBudget* budget_;
    std::uint64_t held_ = 0;
};

}  // namespace vsplit::rest

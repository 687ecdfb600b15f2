#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <utility>

#include "service/memory_budget.h"
#include "vsplit/base/expected.h"

namespace vsplit::service {

/// A value that never changes, in memory while there is room: once it can be loaded again it may leave, and comes back on use.
/// Thread-safe.
template <class Value>
class Kept final : public Evictable, public std::enable_shared_from_this<Kept<Value>> {
    struct Private {};

public:
    using Pointer = std::shared_ptr<const Value>;
    using Load = std::function<Expected<Pointer>()>;

    /// A value that is in memory and nowhere else.
    [[nodiscard]] static std::shared_ptr<Kept> hold(Pointer value, std::uint64_t bytes, MemoryBudget& budget) {
        auto kept = std::make_shared<Kept>(Private(), bytes, budget);
        kept->value_ = std::move(value);
        kept->share_ = budget.charge(bytes);
        budget.touch(kept);
        return kept;
    }

    /// A value that is elsewhere.
    [[nodiscard]] static std::shared_ptr<Kept> elsewhere(Load load, std::uint64_t bytes, MemoryBudget& budget) {
        auto kept = std::make_shared<Kept>(Private(), bytes, budget);
        kept->load_ = std::move(load);
        return kept;
    }

    Kept(Private /*hold and elsewhere make it*/, std::uint64_t bytes, MemoryBudget& budget) : bytes_(bytes), budget_(budget) {}
    ~Kept() override { budget_.forget(this); }

    /// What it takes in memory.
    [[nodiscard]] std::uint64_t bytes() const { return bytes_; }

    [[nodiscard]] MemoryBudget& budget() const { return budget_; }

    /// From now on the value may leave memory.
    void can_be_loaded(Load load) {
        const std::lock_guard lock(mutex_);
        load_ = std::move(load);
    }

    /// Heavy unless it is in memory. \return what the load returns; LIMIT_EXCEEDED where memory has no room for it.
    [[nodiscard]] Expected<Pointer> get() {
        const std::lock_guard lock(mutex_);
        if (!value_) {
            Expected<MemoryBudget::Share> share = budget_.reserve(bytes_, "what is asked for");
            if (!share) return share.error();
            Expected<Pointer> loaded = load_();
            if (!loaded) return loaded.error();
            value_ = *std::move(loaded);
            share_ = *std::move(share);
        }
        budget_.touch(this->shared_from_this());
        return value_;
    }

    bool let_go() override {
        // Whoever holds the lock is loading or just came for the value, and may itself be asking others to let go.
        const std::unique_lock lock(mutex_, std::try_to_lock);
        if (!lock.owns_lock() || !load_ || !value_ || value_.use_count() > 1) return false;
        value_.reset();
        share_.give_back();
        return true;
    }

private:
    const std::uint64_t bytes_;
    MemoryBudget& budget_;
    std::mutex mutex_;
    Load load_;
    Pointer value_;
    MemoryBudget::Share share_;
};

}  // namespace vsplit::service

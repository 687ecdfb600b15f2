#include "service/memory_budget.h"

#include <algorithm>
#include <iterator>
#include <string>
#include <thread>
#include <utility>

#include "service/limits.h"

namespace vsplit::service {
namespace {

constexpr int kMostRounds = 1000;

}  // namespace

MemoryBudget::Share::Share(Share&& other) noexcept
    : budget_(std::exchange(other.budget_, nullptr)), bytes_(std::exchange(other.bytes_, 0)) {}

MemoryBudget::Share& MemoryBudget::Share::operator=(Share&& other) noexcept {
    std::swap(budget_, other.budget_);
    std::swap(bytes_, other.bytes_);
    return *this;
}

void MemoryBudget::Share::give_back() {
    if (budget_ == nullptr) return;
    const std::lock_guard lock(budget_->mutex_);
    budget_->used_ -= bytes_;
    ++budget_->changes_;
    budget_ = nullptr;
}

Expected<MemoryBudget::Share> MemoryBudget::reserve(std::uint64_t bytes, std::string_view what) {
    // What is found in use one after another need not have been so at one time: while others come and go, look again.
    for (int round = 0; round < kMostRounds; ++round) {
        const std::uint64_t before = changes();
        if (take_if_room(bytes, limit_) || take_after_evicting(bytes)) return Share(*this, bytes);
        if (changes() == before) break;
        std::this_thread::yield();
    }
    const Use now = use();
    return Error{Cause::kLimitExceeded,
                 std::string(what) + " takes about " + std::to_string(bytes) + " bytes of memory; " + std::to_string(now.bytes) +
                     " of the server's limit max_memory_bytes, " + std::to_string(now.limit) + ", are in use",
                 "", bytes <= now.limit ? kRetryAfter : 0};
}

bool MemoryBudget::take_after_evicting(std::uint64_t bytes) {
    for (const std::weak_ptr<Evictable>& thing : least_recent_first()) {
        evict(thing);
        if (take_if_room(bytes, limit_)) return true;
    }
    return false;
}

std::uint64_t MemoryBudget::changes() const {
    const std::lock_guard lock(mutex_);
    return changes_;
}

Expected<MemoryBudget::Share> MemoryBudget::borrow(std::uint64_t bytes, std::string_view what) {
    Expected<Share> share = reserve(bytes, what);
    if (!share && take_if_room(bytes, limit_ + limit_ / 4)) return Share(*this, bytes);
    return share;
}

MemoryBudget::Share MemoryBudget::charge(std::uint64_t bytes) {
    {
        const std::lock_guard lock(mutex_);
        used_ += bytes;
    }
    Share share(*this, bytes);
    if (fits()) return share;
    for (const std::weak_ptr<Evictable>& thing : least_recent_first()) {
        evict(thing);
        if (fits()) break;
    }
    return share;
}

void MemoryBudget::touch(const std::shared_ptr<Evictable>& thing) {
    const std::lock_guard lock(mutex_);
    ++changes_;
    const auto place = places_.find(thing.get());
    if (place != places_.end()) {
        entries_.splice(entries_.begin(), entries_, place->second);
        return;
    }
    entries_.push_front({thing.get(), thing});
    places_.emplace(thing.get(), entries_.begin());
}

void MemoryBudget::forget(const Evictable* thing) {
    const std::lock_guard lock(mutex_);
    const auto place = places_.find(thing);
    if (place == places_.end()) return;
    entries_.erase(place->second);
    places_.erase(place);
}

MemoryBudget::Use MemoryBudget::use() const {
    const std::lock_guard lock(mutex_);
    return {used_, limit_, evictions_};
}

bool MemoryBudget::take_if_room(std::uint64_t bytes, std::uint64_t limit) {
    const std::lock_guard lock(mutex_);
    if (limit_ != 0 && (bytes > limit || used_ > limit - bytes)) return false;
    used_ += bytes;
    return true;
}

bool MemoryBudget::fits() const {
    const std::lock_guard lock(mutex_);
    return limit_ == 0 || used_ <= limit_;
}

void MemoryBudget::evict(const std::weak_ptr<Evictable>& thing) {
    const std::shared_ptr<Evictable> there = thing.lock();
    if (!there || !there->let_go()) return;
    const std::lock_guard lock(mutex_);
    ++evictions_;
}

std::vector<std::weak_ptr<Evictable>> MemoryBudget::least_recent_first() const {
    const std::lock_guard lock(mutex_);
    std::vector<std::weak_ptr<Evictable>> things;
    things.reserve(entries_.size());
    std::transform(entries_.rbegin(), entries_.rend(), std::back_inserter(things), [](const Entry& e) { return e.thing; });
    return things;
}

}  // namespace vsplit::service

#pragma once

#include <cstddef>
#include <cstdint>
#include <list>
#include <memory>
#include <mutex>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "vsplit/base/expected.h"

namespace vsplit::service {

/// Something that takes memory and may give it up.
class Evictable {
public:
    Evictable() = default;
    virtual ~Evictable() = default;
    Evictable(const Evictable&) = delete;
    Evictable& operator=(const Evictable&) = delete;

    /// Gives its memory up if nobody needs it there just now. Must not wait. \return whether it did.
    virtual bool let_go() = 0;
};

/// The memory that meshes, representations and methods may take together. What was used least recently gives way first.
/// Thread-safe.
class MemoryBudget {
public:
    /// Bytes of the budget, given back at its end. Empty when moved from.
    class Share {
    public:
        Share() = default;
        Share(MemoryBudget& budget, std::uint64_t bytes) : budget_(&budget), bytes_(bytes) {}
        ~Share() { give_back(); }
        Share(Share&& other) noexcept;
        Share& operator=(Share&& other) noexcept;
        void give_back();

    private:
        MemoryBudget* budget_ = nullptr;
        std::uint64_t bytes_ = 0;
    };

    /// \param limit bytes; 0: no limit.
    explicit MemoryBudget(std::uint64_t limit) : limit_(limit) {}

    /// Room for what does not exist yet. \return LIMIT_EXCEEDED naming max_memory_bytes and `what`. O(things kept).
    [[nodiscard]] Expected<Share> reserve(std::uint64_t bytes, std::string_view what);

    /// Room for what is soon gone again, as a file that is written for a reader. It may go a quarter over the limit, so that
    /// memory full of what cannot leave keeps nobody from reading it. \return as `reserve`.
    [[nodiscard]] Expected<Share> borrow(std::uint64_t bytes, std::string_view what);

    /// Room for what is there already: others give way as far as they can. O(things kept).
    [[nodiscard]] Share charge(std::uint64_t bytes);

    /// A use of `thing`: it gives way last. O(1).
    void touch(const std::shared_ptr<Evictable>& thing);

    /// `thing` is no more. O(1).
    void forget(const Evictable* thing);

    struct Use {
        std::uint64_t bytes = 0;      ///< held now
        std::uint64_t limit = 0;      ///< 0: none
        std::uint64_t evictions = 0;  ///< so far
    };
    [[nodiscard]] Use use() const;

private:
    struct Entry {
        const Evictable* key = nullptr;
        std::weak_ptr<Evictable> thing;
    };

    [[nodiscard]] bool take_if_room(std::uint64_t bytes, std::uint64_t limit);
    [[nodiscard]] bool take_after_evicting(std::uint64_t bytes);
    [[nodiscard]] std::uint64_t changes() const;
    [[nodiscard]] bool fits() const;
    void evict(const std::weak_ptr<Evictable>& thing);
    [[nodiscard]] std::vector<std::weak_ptr<Evictable>> least_recent_first() const;

    const std::uint64_t limit_;
    mutable std::mutex mutex_;  // never held while a thing is asked to let go
    std::uint64_t used_ = 0;
    std::uint64_t evictions_ = 0;
    std::uint64_t changes_ = 0;  // uses of things and memory given back, so far
    std::list<Entry> entries_;   // most recent first
    std::unordered_map<const Evictable*, std::list<Entry>::iterator> places_;
};

}  // namespace vsplit::service

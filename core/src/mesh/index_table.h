#pragma once

#include <cstdint>
#include <vector>

namespace vsplit {

/// A hash table of indices: open addressing, 8 bytes a slot, a third or more of them free. It knows no keys; whoever asks
/// compares what the indices stand for.
class IndexTable {
public:
    /// No index is this one.
    static constexpr std::uint32_t kNone = 0xFFFFFFFF;

    /// Makes room for `count` entries in all. Amortised O(1) an entry when called with growing counts.
    void reserve(std::size_t count);

    /// Fetches the place where `hash` would be, ahead of `find`.
    void prefetch(std::uint32_t hash) const { __builtin_prefetch(&slots_[home(hash)]); }

    /// The index most likely to be found under `hash`; to fetch ahead what it stands for.
    [[nodiscard]] std::uint32_t guess(std::uint32_t hash) const { return slots_[home(hash)].index; }

    /// Calls `visit(index)` for the indices stored under `hash`, until it returns true.
    /// \return the index that ended it, or kNone.
    template <class Visit>
    [[nodiscard]] std::uint32_t find(std::uint32_t hash, Visit visit) const {
        for (std::size_t slot = home(hash); slots_[slot].index != kNone; slot = after(slot)) {
            if (slots_[slot].hash == hash && visit(slots_[slot].index)) return slots_[slot].index;
        }
        return kNone;
    }

    /// \pre there is room (reserve). Entries of equal hash are all kept.
    void insert(std::uint32_t hash, std::uint32_t index);

private:
    struct Slot {
        std::uint32_t hash = 0;
        std::uint32_t index = kNone;
    };

    /// Multiplying maps the hash to any number of slots without a division, and in order: growing then walks memory forwards.
    [[nodiscard]] std::size_t home(std::uint32_t hash) const { return (std::uint64_t{hash} * slots_.size()) >> 32; }
    [[nodiscard]] std::size_t after(std::size_t slot) const { return slot + 1 == slots_.size() ? 0 : slot + 1; }

    std::vector<Slot> slots_;
};

}  // namespace vsplit

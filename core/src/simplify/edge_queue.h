#pragma once

#include <tbb/cache_aligned_allocator.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "mesh/half_edges.h"

namespace vsplit {

/// A heap of edges by priority, largest first, ties by smaller edge number, that can change and drop any edge.
/// Four children a node: a node's children share one or two cache lines. Every operation O(log n).
class EdgeQueue {
public:
    struct Entry {
        double priority = 0;
        HalfEdge edge = 0;
    };

    explicit EdgeQueue(std::size_t half_edges) : slot_(half_edges, kNone) {}

    /// Replaces the content. O(n).
    void assign(const std::vector<Entry>& entries) {
        for (std::size_t i = kRoot; i < heap_.size(); ++i) slot_[heap_[i].edge] = kNone;
        heap_.resize(kRoot);
        heap_.insert(heap_.end(), entries.begin(), entries.end());
        for (std::size_t i = kRoot; i < heap_.size(); ++i) slot_[heap_[i].edge] = static_cast<std::uint32_t>(i);
        for (std::size_t i = heap_.size(); i-- > kRoot;) sink(i);
    }

    [[nodiscard]] bool empty() const { return heap_.size() == kRoot; }
    [[nodiscard]] const Entry& top() const { return heap_[kRoot]; }

    /// Inserts the edge or changes its priority.
    void set(HalfEdge edge, double priority) {
        const std::uint32_t i = slot_[edge];
        if (i == kNone) {
            heap_.push_back({priority, edge});
            return rise(heap_.size() - 1);
        }
        const double before = heap_[i].priority;
        heap_[i].priority = priority;
        priority > before ? rise(i) : sink(i);
    }

    /// Drops the edge if it is there.
    void erase(HalfEdge edge) {
        const std::uint32_t i = slot_[edge];
        if (i == kNone) return;
        slot_[edge] = kNone;
        const Entry last = heap_.back();
        heap_.pop_back();
        if (i == heap_.size()) return;
        place(i, last);
        if (i > kRoot && before(last, heap_[parent_of(i)])) return rise(i);
        sink(i);
    }

private:
    // The root stands at 3, so that the four children of a node, at 4 i - 8 to 4 i - 5, fill one cache line.
    static constexpr std::size_t kArity = 4;
    static constexpr std::size_t kRoot = 3;

    static std::size_t parent_of(std::size_t i) { return (i + 8) / kArity; }
    static std::size_t first_child_of(std::size_t i) { return kArity * i - 8; }

    static bool before(const Entry& left, const Entry& right) {
        return left.priority != right.priority ? left.priority > right.priority : left.edge < right.edge;
    }
    void place(std::size_t i, const Entry& entry) {
        heap_[i] = entry;
        slot_[entry.edge] = static_cast<std::uint32_t>(i);
    }
    void rise(std::size_t i) {
        const Entry moving = heap_[i];
        for (; i > kRoot && before(moving, heap_[parent_of(i)]); i = parent_of(i)) place(i, heap_[parent_of(i)]);
        place(i, moving);
    }
    void sink(std::size_t i) {
        const Entry moving = heap_[i];
        for (std::size_t first = first_child_of(i); first < heap_.size(); first = first_child_of(i)) {
            const std::size_t best = best_child(first);
            if (!before(heap_[best], moving)) break;
            place(i, heap_[best]);
            i = best;
        }
        place(i, moving);
    }
    [[nodiscard]] std::size_t best_child(std::size_t first) const {
        const std::size_t end = std::min(first + kArity, heap_.size());
        std::size_t best = first;
        for (std::size_t child = first + 1; child < end; ++child) {
            if (before(heap_[child], heap_[best])) best = child;
        }
        return best;
    }

    using Entries = std::vector<Entry, tbb::cache_aligned_allocator<Entry>>;
    Entries heap_ = Entries(kRoot);     // the first kRoot stand empty
    std::vector<std::uint32_t> slot_;   // of an edge in the heap, or kNone
};

}  // namespace vsplit

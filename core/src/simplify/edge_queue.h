#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
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
    void assign(std::vector<Entry> entries) {
        for (const Entry& entry : heap_) slot_[entry.edge] = kNone;
        heap_ = std::move(entries);
        for (std::size_t i = 0; i < heap_.size(); ++i) slot_[heap_[i].edge] = static_cast<std::uint32_t>(i);
        for (std::size_t i = heap_.size() / kArity + 1; i-- > 0;) sink(i);
    }

    [[nodiscard]] bool empty() const { return heap_.empty(); }
    [[nodiscard]] const Entry& top() const { return heap_.front(); }

    /// Inserts the edge or changes its priority.
    void set(HalfEdge edge, double priority) {
        std::uint32_t i = slot_[edge];
        if (i == kNone) {
            i = static_cast<std::uint32_t>(heap_.size());
            heap_.push_back({priority, edge});
            return rise(i);
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
        rise(i);
        sink(slot_[last.edge]);
    }

private:
    static constexpr std::size_t kArity = 4;

    static bool before(const Entry& left, const Entry& right) {
        return left.priority != right.priority ? left.priority > right.priority : left.edge < right.edge;
    }
    void place(std::size_t i, const Entry& entry) {
        heap_[i] = entry;
        slot_[entry.edge] = static_cast<std::uint32_t>(i);
    }
    void rise(std::size_t i) {
        const Entry moving = heap_[i];
        while (i > 0) {
            const std::size_t parent = (i - 1) / kArity;
            if (!before(moving, heap_[parent])) break;
            place(i, heap_[parent]);
            i = parent;
        }
        place(i, moving);
    }
    void sink(std::size_t i) {
        if (i >= heap_.size()) return;
        const Entry moving = heap_[i];
        for (std::size_t first = i * kArity + 1; first < heap_.size(); first = i * kArity + 1) {
            std::size_t best = first;
            const std::size_t end = first + kArity < heap_.size() ? first + kArity : heap_.size();
            for (std::size_t child = first + 1; child < end; ++child) {
                if (before(heap_[child], heap_[best])) best = child;
            }
            if (!before(heap_[best], moving)) break;
            place(i, heap_[best]);
            i = best;
        }
        place(i, moving);
    }

    std::vector<Entry> heap_;
    std::vector<std::uint32_t> slot_;   // of an edge in the heap, or kNone
};

}  // namespace vsplit

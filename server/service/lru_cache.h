#pragma once

#include <algorithm>
#include <cstddef>
#include <list>
#include <memory>
#include <mutex>

namespace vsplit::service {

/// The last few values made, by key; a handful of them, so a list will do. Thread-safe.
template <class Value>
class LruCache {
public:
    using Pointer = std::shared_ptr<const Value>;

    /// \pre capacity > 0.
    explicit LruCache(std::size_t capacity) : capacity_(capacity) {}

    /// Null when it is not kept.
    [[nodiscard]] Pointer find(std::size_t key) {
        const std::lock_guard lock(mutex_);
        return find_locked(key);
    }

    /// Keeps `value`, and the least recently used one no longer. Where another caller was quicker its value stays.
    /// \return the value that is kept.
    Pointer insert(std::size_t key, Pointer value) {
        std::list<Entry> dropped;  // dies after the lock is released
        const std::lock_guard lock(mutex_);
        if (Pointer found = find_locked(key)) return found;
        entries_.push_front({key, value});
        if (entries_.size() > capacity_) dropped.splice(dropped.begin(), entries_, std::prev(entries_.end()));
        return value;
    }

private:
    struct Entry {
        std::size_t key = 0;
        Pointer value;
    };

    Pointer find_locked(std::size_t key) {
        const auto found = std::find_if(entries_.begin(), entries_.end(), [key](const Entry& e) { return e.key == key; });
        if (found == entries_.end()) return nullptr;
        entries_.splice(entries_.begin(), entries_, found);
        return found->value;
    }

    const std::size_t capacity_;
    std::mutex mutex_;
    std::list<Entry> entries_;
};

}  // namespace vsplit::service

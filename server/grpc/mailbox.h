#pragma once

#include <mutex>
#include <optional>
#include <utility>

namespace vsplit::rpc {

/// Holds the last value put in until it is taken out. Thread-safe.
template <class Value>
class Mailbox {
public:
    void put(Value value) {
        const std::lock_guard lock(mutex_);
        value_.emplace(std::move(value));
    }

    [[nodiscard]] std::optional<Value> take() {
        const std::lock_guard lock(mutex_);
        return std::exchange(value_, std::nullopt);
    }

private:
    std::mutex mutex_;
    std::optional<Value> value_;
};

}  // namespace vsplit::rpc

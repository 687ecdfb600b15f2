#pragma once

#include <cassert>
#include <utility>
#include <variant>

#include "vsplit/base/error.h"

namespace vsplit {

/// A value, or the Error that kept it from being made.
///
///     Expected<TriangleMesh> mesh = read_mesh_file(path, {});
///     if (!mesh) return mesh.error();
///     use(*mesh);
///
/// \pre `*` and `->` need a value, `error()` needs an error; asking for the other is a programmer's error (assert).
template <class T>
class [[nodiscard]] Expected {
public:
    Expected(T value) : state_(std::in_place_index<0>, std::move(value)) {}      // NOLINT(google-explicit-constructor)
    Expected(Error error) : state_(std::in_place_index<1>, std::move(error)) {}  // NOLINT(google-explicit-constructor)

    [[nodiscard]] bool has_value() const { return state_.index() == 0; }
    explicit operator bool() const { return has_value(); }

    [[nodiscard]] const T& operator*() const& { return value(); }
    [[nodiscard]] T& operator*() & { return value(); }
    [[nodiscard]] T&& operator*() && { return std::move(value()); }
    [[nodiscard]] const T* operator->() const { return &value(); }
    [[nodiscard]] T* operator->() { return &value(); }
    [[nodiscard]] const Error& error() const {
        assert(!has_value());
        return *std::get_if<1>(&state_);
    }

private:
    [[nodiscard]] const T& value() const {
        assert(has_value());
        return *std::get_if<0>(&state_);
    }
    [[nodiscard]] T& value() {
        assert(has_value());
        return *std::get_if<0>(&state_);
    }

    std::variant<T, Error> state_;
};

/// The value of what can fail but has nothing to return.
struct Done {};

/// Success without a value, or an Error.
using Status = Expected<Done>;

}  // namespace vsplit

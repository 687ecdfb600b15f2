#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <string>
#include <string_view>
#include <type_traits>

#include "vsplit/mesh/triangle_mesh.h"

namespace vsplit {

/// Words as text and numbers as text or bytes, whichever a format's file is of.
class NumberWriter {
public:
    enum class As { kText, kLittleEndian, kBigEndian };

    explicit NumberWriter(As as) : as_(as) {}

    NumberWriter& operator<<(std::string_view words) {
        bytes_ += words;
        return *this;
    }

    /// A number as `T`; in text with a blank behind it.
    template <class T>
    void put(T value) {
        static_assert(std::is_arithmetic_v<T>);
        if (as_ == As::kText) {
            std::array<char, 32> digits;  // the longest double has 24
            const std::to_chars_result end = std::to_chars(digits.data(), digits.data() + digits.size(), value);
            bytes_.append(digits.data(), end.ptr);
            bytes_ += ' ';
            return;
        }
        auto raw = std::bit_cast<std::array<char, sizeof(T)>>(value);
        const std::endian order = as_ == As::kBigEndian ? std::endian::big : std::endian::little;
        if (order != std::endian::native) std::reverse(raw.begin(), raw.end());
        bytes_.append(raw.data(), raw.size());
    }

    void put(const Vec3& point) {
        for (int axis = 0; axis < 3; ++axis) put(point[axis]);
    }

    /// The end of a row: bytes have none.
    void end_row() {
        if (as_ == As::kText) bytes_ += "\n";
    }

    [[nodiscard]] std::string take() { return std::move(bytes_); }

private:
    As as_;
    std::string bytes_;
};

}  // namespace vsplit

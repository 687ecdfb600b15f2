#pragma once

#include <array>
#include <charconv>
#include <string>
#include <string_view>

#include "vsplit/mesh/triangle_mesh.h"

namespace vsplit {

/// Appends words and numbers to a text. Numbers are the shortest that read back equal, in the C locale.
class TextWriter {
public:
    /// \pre `expected_bytes` is a guess; the text may be longer.
    explicit TextWriter(std::size_t expected_bytes) { text_.reserve(expected_bytes); }

    TextWriter& operator<<(std::string_view words) {
        text_ += words;
        return *this;
    }

    template <class Number>
    requires std::is_arithmetic_v<Number> TextWriter& operator<<(Number number) {
        std::array<char, 32> digits;  // the longest double has 24
        const std::to_chars_result end = std::to_chars(digits.data(), digits.data() + digits.size(), number);
        text_.append(digits.data(), end.ptr);
        return *this;
    }

    TextWriter& operator<<(const Vec3& point) { return *this << point.x() << " " << point.y() << " " << point.z(); }

    [[nodiscard]] std::size_t size() const { return text_.size(); }
    [[nodiscard]] std::string take() { return std::move(text_); }

private:
    std::string text_;
};

/// A line a vertex and a line a face, as OFF and PLY have them.
inline void write_rows(TextWriter& text, const TriangleMesh& mesh) {
    for (const Vec3& position : mesh.positions) text << position << "\n";
    for (const Triangle& face : mesh.faces) text << "3 " << face[0] << " " << face[1] << " " << face[2] << "\n";
}

/// A fair guess at the text of a vertex with three doubles, and of a face.
inline constexpr std::size_t kVertexTextBytes = 48;
inline constexpr std::size_t kFaceTextBytes = 24;

}  // namespace vsplit

#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "colour.h"
#include "vsplit/base/expected.h"

namespace vsplit::render {

/// Pixels, the origin at the top left.
struct Rectangle {
    int left = 0;
    int top = 0;
    int width = 0;
    int height = 0;
};

/// An image of one background colour to draw on; what falls outside is dropped.
class Picture {
public:
    Picture(int width, int height, Colour background);

    [[nodiscard]] int width() const { return width_; }
    [[nodiscard]] int height() const { return height_; }
    [[nodiscard]] Colour at(int x, int y) const { return pixels_[index(x, y)]; }

    /// \pre the pixel lies inside.
    void set(int x, int y, Colour colour) { pixels_[index(x, y)] = colour; }
    void blend(int x, int y, Colour colour, double opacity);
    void fill(const Rectangle& area, Colour colour);
    void outline(const Rectangle& area, Colour colour, int thickness);
    void paste(const Picture& other, int left, int top);

    /// Mean of blocks of `factor` x `factor` pixels. \pre both sides are multiples of factor.
    [[nodiscard]] Picture shrunk(int factor) const;

    /// 8 bits a channel. FILE_ACCESS when the file cannot be written.
    [[nodiscard]] Status write_png(const std::filesystem::path& path) const;

private:
    [[nodiscard]] std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
    }

    int width_;
    int height_;
    std::vector<Colour> pixels_;
};

}  // namespace vsplit::render

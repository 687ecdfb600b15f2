#pragma once

#include <filesystem>
#include <memory>
#include <string_view>

#include "picture.h"
#include "vsplit/base/expected.h"

namespace vsplit::render {

/// Draws lines of ASCII text in one typeface; other bytes are drawn as '?'.
class Typeface {
public:
    /// A TrueType file. FILE_ACCESS when it cannot be opened.
    [[nodiscard]] static Expected<Typeface> open(const std::filesystem::path& path);

    Typeface(Typeface&&) noexcept;
    Typeface& operator=(Typeface&&) noexcept;
    ~Typeface();

    /// Draws with the baseline's left end at (x, y); `size` is the height of the em square, pixels. \return the width drawn.
    int draw(Picture& picture, int x, int y, int size, Colour colour, std::string_view text) const;

    [[nodiscard]] int width(int size, std::string_view text) const;

private:
    struct Face;
    explicit Typeface(std::unique_ptr<Face> face);
    std::unique_ptr<Face> face_;
};

}  // namespace vsplit::render

#pragma once

namespace vsplit::render {

/// sRGB, each channel 0..1.
struct Colour {
    float red = 0;
    float green = 0;
    float blue = 0;
};

inline constexpr Colour kInk{0.13F, 0.15F, 0.18F};
inline constexpr Colour kPaleInk{0.42F, 0.45F, 0.50F};
inline constexpr Colour kPaper{1.0F, 1.0F, 1.0F};
inline constexpr Colour kPanel{0.955F, 0.962F, 0.972F};

/// `share` 0 gives `from`, 1 gives `to`.
[[nodiscard]] Colour mix(Colour from, Colour to, double share);

/// Red below the floor of 0.2, where solvers refuse; then orange, yellow, green and blue at 1.
[[nodiscard]] Colour stretch_colour(double stretch);

}  // namespace vsplit::render

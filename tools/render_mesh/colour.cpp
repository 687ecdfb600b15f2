#include "colour.h"

#include <algorithm>
#include <array>

#include "vsplit/quality/stretch.h"

namespace vsplit::render {
namespace {

struct Stop {
    double stretch;
    Colour colour;
};

// Two stops at the floor: the step from red to orange makes the faces that are not fit for use stand out.
constexpr std::array<Stop, 7> kStops{{{0.0, {0.60F, 0.02F, 0.08F}},
                                      {kStretchFloor, {0.88F, 0.13F, 0.12F}},
                                      {kStretchFloor, {0.96F, 0.50F, 0.14F}},
                                      {0.45, {0.99F, 0.84F, 0.25F}},
                                      {0.65, {0.62F, 0.83F, 0.36F}},
                                      {0.82, {0.27F, 0.75F, 0.57F}},
                                      {1.0, {0.25F, 0.58F, 0.87F}}}};

}  // namespace

Colour mix(Colour from, Colour to, double share) {
    const auto part = static_cast<float>(std::clamp(share, 0.0, 1.0));
    return {from.red + part * (to.red - from.red), from.green + part * (to.green - from.green),
            from.blue + part * (to.blue - from.blue)};
}

Colour stretch_colour(double stretch) {
    for (std::size_t i = 1; i < kStops.size(); ++i) {
        const Stop& low = kStops[i - 1];
        const Stop& high = kStops[i];
        if (stretch < high.stretch) return mix(low.colour, high.colour, (stretch - low.stretch) / (high.stretch - low.stretch));
    }
    return kStops.back().colour;
}

}  // namespace vsplit::render

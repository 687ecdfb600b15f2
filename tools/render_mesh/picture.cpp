#include "picture.h"

#include <png.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace vsplit::render {
namespace {

std::uint8_t to_byte(float channel) { return static_cast<std::uint8_t>(std::lround(std::clamp(channel, 0.0F, 1.0F) * 255.0F)); }

std::vector<std::uint8_t> to_bytes(const std::vector<Colour>& pixels) {
    std::vector<std::uint8_t> bytes;
    bytes.reserve(3 * pixels.size());
    for (const Colour& pixel : pixels) {
        bytes.push_back(to_byte(pixel.red));
        bytes.push_back(to_byte(pixel.green));
        bytes.push_back(to_byte(pixel.blue));
    }
    return bytes;
}

}  // namespace

Picture::Picture(int width, int height, Colour background)
    : width_(width), height_(height), pixels_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), background) {}

void Picture::blend(int x, int y, Colour colour, double opacity) {
    if (x < 0 || y < 0 || x >= width_ || y >= height_) return;
    set(x, y, mix(at(x, y), colour, opacity));
}

void Picture::fill(const Rectangle& area, Colour colour) {
    for (int y = std::max(0, area.top); y < std::min(height_, area.top + area.height); ++y) {
        for (int x = std::max(0, area.left); x < std::min(width_, area.left + area.width); ++x) set(x, y, colour);
    }
}

void Picture::outline(const Rectangle& area, Colour colour, int thickness) {
    fill({area.left, area.top, area.width, thickness}, colour);
    fill({area.left, area.top + area.height - thickness, area.width, thickness}, colour);
    fill({area.left, area.top, thickness, area.height}, colour);
    fill({area.left + area.width - thickness, area.top, thickness, area.height}, colour);
}

void Picture::paste(const Picture& other, int left, int top) {
    for (int y = 0; y < other.height(); ++y) {
        for (int x = 0; x < other.width(); ++x) blend(left + x, top + y, other.at(x, y), 1.0);
    }
}

Picture Picture::shrunk(int factor) const {
    Picture small(width_ / factor, height_ / factor, {});
    const float share = 1.0F / static_cast<float>(factor * factor);
    for (int y = 0; y < height_; ++y) {
        for (int x = 0; x < width_; ++x) {
            const Colour pixel = at(x, y);
            Colour& sum = small.pixels_[small.index(x / factor, y / factor)];
            sum.red += share * pixel.red;
            sum.green += share * pixel.green;
            sum.blue += share * pixel.blue;
        }
    }
    return small;
}

Status Picture::write_png(const std::filesystem::path& path) const {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = static_cast<png_uint_32>(width_);
    image.height = static_cast<png_uint_32>(height_);
    image.format = PNG_FORMAT_RGB;
    const std::vector<std::uint8_t> bytes = to_bytes(pixels_);
    if (png_image_write_to_file(&image, path.c_str(), 0, bytes.data(), 0, nullptr) == 0) {
        return Error{Cause::kFileAccess, path.string() + ": " + static_cast<const char*>(image.message), ""};
    }
    return Done{};
}

}  // namespace vsplit::render

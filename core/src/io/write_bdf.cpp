#include <algorithm>
#include <array>
#include <charconv>
#include <string>

#include "io/named_regions.h"
#include "io/text_writer.h"
#include "io/writers.h"

namespace vsplit {
namespace {

constexpr std::size_t kWide = 16;
constexpr std::size_t kNarrow = 8;

/// With a point and without an E, as Nastran allows: "1.5e-07" as "1.5-7", "0.25" as ".25".
std::string without_e(std::string text) {
    const std::size_t e = text.find('e');
    std::string exponent = e == std::string::npos ? "" : text.substr(e + 1);
    text.resize(std::min(e, text.size()));
    if (text.find('.') == std::string::npos) text += '.';
    if (exponent.size() > 2 && exponent[1] == '0') exponent.erase(1, 1);
    const std::size_t zero = text.front() == '-' ? 1 : 0;
    if (text.size() > zero + 2 && text[zero] == '0') text.erase(zero, 1);
    return text + exponent;
}

/// A number in at most 16 characters, as precise as that allows: to 11 digits at least.
std::string nastran_real(double value) {
    std::array<char, 32> digits;
    for (int precision = 17; precision > 0; --precision) {
        for (const auto form : {std::chars_format::general, std::chars_format::scientific}) {
            const int behind = form == std::chars_format::general ? precision : precision - 1;
            const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value, form, behind);
            std::string text = without_e({digits.data(), end.ptr});
            if (text.size() <= kWide) return text;
        }
    }
    return "0.";
}

std::string field(std::string text, std::size_t width) {
    text.resize(std::max(width, text.size()), ' ');
    return text;
}

std::string field(std::uint64_t number, std::size_t width) { return field(std::to_string(number), width); }

void write_grid(TextWriter& text, std::uint64_t id, const Vec3& p) {
    text << "GRID*   " << field(id, kWide) << field("", kWide) << field(nastran_real(p.x()), kWide)
         << field(nastran_real(p.y()), kWide) << "\n*       " << nastran_real(p.z()) << "\n";
}

void write_face(TextWriter& text, std::uint64_t id, std::uint64_t property, const Triangle& face) {
    constexpr std::uint64_t kLargestNarrow = 99'999'999;
    const std::uint64_t largest = std::max({id, property, std::uint64_t{*std::max_element(face.begin(), face.end())} + 1});
    const std::size_t width = largest > kLargestNarrow ? kWide : kNarrow;
    text << (width == kWide ? "CTRIA3* " : "CTRIA3  ") << field(id, width) << field(property, width);
    text << field(std::uint64_t{face[0]} + 1, width) << field(std::uint64_t{face[1]} + 1, width);
    if (width == kWide) text << "\n*       ";
    text << std::to_string(std::uint64_t{face[2]} + 1) << "\n";
}

}  // namespace

std::string write_bdf(const TriangleMesh& mesh) {
    TextWriter text(mesh.positions.size() * 100 + mesh.faces.size() * 50);
    text << "$ vsplit\nBEGIN BULK\n";
    const std::vector<NamedRegion> regions = named_regions(mesh);
    const std::uint64_t for_none = mesh.regions.empty() || regions.empty() ? 1 : std::uint64_t{regions.back().region} + 1;
    for (const NamedRegion& region : regions) {
        if (region.has_name && region.region != 0) {
            std::string name = region.name;
            std::replace(name.begin(), name.end(), '"', '\'');
            text << "$HMNAME COMP  " << field(region.region, kWide) << "\"" << name << "\"\n";
        }
    }
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) write_grid(text, v + 1, mesh.positions[v]);
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
        const std::uint32_t region = mesh.regions.empty() ? 0 : mesh.regions[f];
        write_face(text, f + 1, region == 0 ? for_none : region, mesh.faces[f]);
    }
    text << "ENDDATA\n";
    return text.take();
}

}  // namespace vsplit

#include <algorithm>
#include <string>

#include "io/elements.h"
#include "io/named_regions.h"
#include "io/narrow_number.h"
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

/// To 11 digits at least.
std::string nastran_real(double value) { return number_within(value, kWide, without_e); }

std::string field(std::string text, std::size_t width) {
    text.resize(std::max(width, text.size()), ' ');
    return text;
}

std::string field(std::uint64_t number, std::size_t width) { return field(std::to_string(number), width); }

void write_grid(TextWriter& text, std::uint64_t id, const Vec3& p) {
    text << "GRID*   " << field(id, kWide) << field("", kWide) << field(nastran_real(p.x()), kWide)
         << field(nastran_real(p.y()), kWide) << "\n*       " << nastran_real(p.z()) << "\n";
}

void write_face(TextWriter& text, const Elements& elements, std::size_t f, std::uint64_t property) {
    constexpr std::uint64_t kLargestNarrow = 99'999'999;
    const bool wide = std::max({std::uint64_t{f} + 1, property, std::uint64_t{elements.node_count()}}) > kLargestNarrow;
    const std::size_t width = wide ? kWide : kNarrow;
    const std::uint32_t nodes = elements.order_nodes();
    text << (nodes == 3 ? "CTRIA3" : "CTRIA6") << (wide ? "* " : "  ") << field(std::uint64_t{f} + 1, width)
         << field(property, width);
    for (std::uint32_t i = 0; i < nodes; ++i) {
        // A line of wide fields has four of them.
        if (wide && i == 2) text << "\n*       ";
        const std::uint64_t id = std::uint64_t{elements.node(f, i)} + 1;
        text << (i + 1 == nodes ? std::to_string(id) : field(id, width));
    }
    text << "\n";
}

}  // namespace

std::string write_bdf(const Elements& elements) {
    const TriangleMesh& mesh = elements.mesh();
    TextWriter text(elements.node_count() * 100 + mesh.faces.size() * 50);
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
    for (std::size_t v = 0; v < elements.node_count(); ++v) write_grid(text, v + 1, elements.position(v));
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
        const std::uint32_t region = mesh.regions.empty() ? 0 : mesh.regions[f];
        write_face(text, elements, f, region == 0 ? for_none : region);
    }
    text << "ENDDATA\n";
    return text.take();
}

}  // namespace vsplit

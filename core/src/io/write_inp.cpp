#include <algorithm>
#include <string>
#include <vector>

#include "io/elements.h"
#include "io/named_regions.h"
#include "io/narrow_number.h"
#include "io/text_writer.h"
#include "io/writers.h"

namespace vsplit {
namespace {

/// CalculiX reads 20 characters of a number and takes no notice of the rest, be it an exponent. To 13 digits at least.
std::string deck_real(double value) {
    constexpr std::size_t kRead = 20;
    return number_within(value, kRead, [](const std::string& text) { return text; });
}

/// Numbers in rows of eight, as input decks have them at most sixteen.
void write_numbers(TextWriter& text, const std::vector<std::uint32_t>& numbers) {
    constexpr std::size_t kInARow = 8;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        text << std::uint64_t{numbers[i]} + 1 << ((i + 1) % kInARow == 0 || i + 1 == numbers.size() ? "\n" : ", ");
    }
}

void write_set(TextWriter& text, const Elements& elements, const FaceSet& set, const FacesOfRegions& faces_of) {
    const std::vector<std::uint32_t> faces = faces_of_set(set, faces_of);
    std::vector<std::uint32_t> nodes;
    for (const std::uint32_t f : faces) {
        for (std::uint32_t i = 0; i < elements.order_nodes(); ++i) nodes.push_back(elements.node(f, i));
    }
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    text << "*ELSET, ELSET=" << set.name << "\n";
    write_numbers(text, faces);
    text << "*NSET, NSET=" << set.name << "_nodes\n";
    write_numbers(text, nodes);
    text << "*SURFACE, NAME=" << set.name << kSurfaceSuffix << ", TYPE=ELEMENT\n" << set.name << ", SPOS\n";
}

}  // namespace

std::string write_inp(const Elements& elements) {
    const TriangleMesh& mesh = elements.mesh();
    TextWriter text(elements.node_count() * kVertexTextBytes + mesh.faces.size() * kFaceTextBytes);
    text << "*HEADING\nvsplit\n*NODE, NSET=Nall\n";
    for (std::size_t v = 0; v < elements.node_count(); ++v) {
        const Vec3& p = elements.position(v);
        text << v + 1 << ", " << deck_real(p.x()) << ", " << deck_real(p.y()) << ", " << deck_real(p.z()) << "\n";
    }
    text << "*ELEMENT, TYPE=S" << elements.order_nodes() << ", ELSET=" << kAllElements << "\n";
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
        text << f + 1;
        for (std::uint32_t i = 0; i < elements.order_nodes(); ++i) text << ", " << std::uint64_t{elements.node(f, i)} + 1;
        text << "\n";
    }
    if (!mesh.regions.empty()) {
        const FacesOfRegions faces_of = faces_of_regions(mesh);
        for (const FaceSet& set : sets_for_solvers(mesh)) write_set(text, elements, set, faces_of);
    }
    return text.take();
}

}  // namespace vsplit

#include <algorithm>
#include <vector>

#include "io/elements.h"
#include "io/named_regions.h"
#include "io/text_writer.h"
#include "io/writers.h"

namespace vsplit {
namespace {

/// Numbers in rows of eight, as input decks have them at most sixteen.
void write_numbers(TextWriter& text, const std::vector<std::uint32_t>& numbers) {
    constexpr std::size_t kInARow = 8;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        text << std::uint64_t{numbers[i]} + 1 << ((i + 1) % kInARow == 0 || i + 1 == numbers.size() ? "\n" : ", ");
    }
}

void write_set(TextWriter& text, const Elements& elements, const FaceSet& set) {
    const TriangleMesh& mesh = elements.mesh();
    std::vector<std::uint32_t> faces;
    std::vector<std::uint32_t> nodes;
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
        if (std::find(set.regions.begin(), set.regions.end(), mesh.regions[f]) == set.regions.end()) continue;
        faces.push_back(f);
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
        text << v + 1 << ", " << p.x() << ", " << p.y() << ", " << p.z() << "\n";
    }
    text << "*ELEMENT, TYPE=S" << elements.order_nodes() << ", ELSET=" << kAllElements << "\n";
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
        text << f + 1;
        for (std::uint32_t i = 0; i < elements.order_nodes(); ++i) text << ", " << std::uint64_t{elements.node(f, i)} + 1;
        text << "\n";
    }
    if (!mesh.regions.empty()) {
        for (const FaceSet& set : sets_for_solvers(mesh)) write_set(text, elements, set);
    }
    return text.take();
}

}  // namespace vsplit

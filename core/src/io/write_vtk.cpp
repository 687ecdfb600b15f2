#include "io/elements.h"
#include "io/number_writer.h"
#include "io/writers.h"

namespace vsplit {

std::string write_vtk(const Elements& elements, bool text) {
    const TriangleMesh& mesh = elements.mesh();
    const std::uint32_t nodes = elements.order_nodes();
    NumberWriter out(text ? NumberWriter::As::kText : NumberWriter::As::kBigEndian);
    const std::string faces = std::to_string(mesh.faces.size());
    out << "# vtk DataFile Version 3.0\nvsplit\n" << (text ? "ASCII" : "BINARY") << "\nDATASET UNSTRUCTURED_GRID\n";
    out << "POINTS " << std::to_string(elements.node_count()) << " double\n";
    for (std::size_t node = 0; node < elements.node_count(); ++node) {
        out.put(elements.position(node));
        out.end_row();
    }
    out << "\nCELLS " << faces << " " << std::to_string((nodes + 1) * mesh.faces.size()) << "\n";
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
        out.put(static_cast<std::int32_t>(nodes));
        for (std::uint32_t i = 0; i < nodes; ++i) out.put(static_cast<std::int32_t>(elements.node(f, i)));
        out.end_row();
    }
    const std::int32_t type = nodes == 3 ? 5 : 22;
    out << "\nCELL_TYPES " << faces << "\n";
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
        out.put(type);
        out.end_row();
    }
    if (!mesh.regions.empty()) {
        out << "\nCELL_DATA " << faces << "\nSCALARS region unsigned_int 1\nLOOKUP_TABLE default\n";
        for (const std::uint32_t region : mesh.regions) {
            out.put(region);
            out.end_row();
        }
    }
    out << "\n";
    return out.take();
}

}  // namespace vsplit

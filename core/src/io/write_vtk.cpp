#include "io/number_writer.h"
#include "io/writers.h"

namespace vsplit {

std::string write_vtk(const TriangleMesh& mesh, bool text) {
    NumberWriter out(text ? NumberWriter::As::kText : NumberWriter::As::kBigEndian);
    const std::string faces = std::to_string(mesh.faces.size());
    out << "# vtk DataFile Version 3.0\nvsplit\n" << (text ? "ASCII" : "BINARY") << "\nDATASET UNSTRUCTURED_GRID\n";
    out << "POINTS " << std::to_string(mesh.positions.size()) << " double\n";
    for (const Vec3& position : mesh.positions) {
        out.put(position);
        out.end_row();
    }
    out << "\nCELLS " << faces << " " << std::to_string(4 * mesh.faces.size()) << "\n";
    for (const Triangle& face : mesh.faces) {
        out.put(std::int32_t{3});
        for (const std::uint32_t v : face) out.put(static_cast<std::int32_t>(v));
        out.end_row();
    }
    constexpr std::int32_t kTriangle = 5;
    out << "\nCELL_TYPES " << faces << "\n";
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
        out.put(kTriangle);
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

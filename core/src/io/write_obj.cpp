#include "io/text_writer.h"
#include "io/writers.h"

namespace vsplit {

std::string write_obj(const TriangleMesh& mesh) {
    TextWriter text(mesh.positions.size() * kVertexTextBytes + mesh.faces.size() * kFaceTextBytes);
    for (const Vec3& position : mesh.positions) text << "v " << position << "\n";
    for (const Triangle& face : mesh.faces) {
        text << "f";
        for (const std::uint32_t vertex : face) text << " " << std::uint64_t{vertex} + 1;
        text << "\n";
    }
    return text.take();
}

}  // namespace vsplit

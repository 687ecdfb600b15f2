#include "io/text_writer.h"
#include "io/writers.h"

namespace vsplit {

std::string write_off(const TriangleMesh& mesh) {
    TextWriter text(mesh.positions.size() * kVertexTextBytes + mesh.faces.size() * kFaceTextBytes);
    text << "OFF\n" << mesh.vertex_count() << " " << mesh.face_count() << " 0\n";
    write_rows(text, mesh);
    return text.take();
}

}  // namespace vsplit

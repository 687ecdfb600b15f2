#include <algorithm>

#include "base/byte_order.h"
#include "io/text_writer.h"
#include "io/writers.h"

namespace vsplit {
namespace {

std::string header(const TriangleMesh& mesh, std::string_view encoding) {
    TextWriter text(0);
    text << "ply\nformat " << encoding << " 1.0\ncomment by vsplit\n";
    text << "element vertex " << mesh.vertex_count() << "\nproperty double x\nproperty double y\nproperty double z\n";
    text << "element face " << mesh.face_count() << "\nproperty list uchar uint vertex_indices\n";
    text << (mesh.regions.empty() ? "end_header\n" : "property uint region\nend_header\n");
    return text.take();
}

}  // namespace

std::string write_ply_binary(const TriangleMesh& mesh) {
    constexpr std::size_t kVertexBytes = 3 * sizeof(double);
    const std::size_t face_bytes = 1 + (mesh.regions.empty() ? 3 : 4) * sizeof(std::uint32_t);
    const std::string start = header(mesh, "binary_little_endian");
    std::string bytes(start.size() + mesh.positions.size() * kVertexBytes + mesh.faces.size() * face_bytes, '\0');
    char* to = std::copy(start.begin(), start.end(), bytes.data());
    for (const Vec3& position : mesh.positions) {
        for (int axis = 0; axis < 3; ++axis) to = store(to, position[axis]);
    }
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
        to = store(to, std::uint8_t{3});
        for (const std::uint32_t vertex : mesh.faces[f]) to = store(to, vertex);
        if (!mesh.regions.empty()) to = store(to, mesh.regions[f]);
    }
    return bytes;
}

std::string write_ply_ascii(const TriangleMesh& mesh) {
    TextWriter text(mesh.positions.size() * kVertexTextBytes + mesh.faces.size() * kFaceTextBytes);
    text << header(mesh, "ascii");
    if (mesh.regions.empty()) {
        write_rows(text, mesh);
        return text.take();
    }
    for (const Vec3& position : mesh.positions) text << position << "\n";
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
        const Triangle& t = mesh.faces[f];
        text << "3 " << t[0] << " " << t[1] << " " << t[2] << " " << mesh.regions[f] << "\n";
    }
    return text.take();
}

}  // namespace vsplit

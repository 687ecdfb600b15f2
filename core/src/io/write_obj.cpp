#include "io/named_regions.h"
#include "io/text_writer.h"
#include "io/writers.h"

namespace vsplit {

std::string write_obj(const TriangleMesh& mesh) {
    TextWriter text(mesh.positions.size() * kVertexTextBytes + mesh.faces.size() * kFaceTextBytes);
    for (const Vec3& position : mesh.positions) text << "v " << position << "\n";
    const auto write_face = [&](const Triangle& face) {
        text << "f";
        for (const std::uint32_t vertex : face) text << " " << std::uint64_t{vertex} + 1;
        text << "\n";
    };
    if (mesh.regions.empty()) {
        for (const Triangle& face : mesh.faces) write_face(face);
        return text.take();
    }
    // A group once, with all its faces: readers take a name that comes again for another group.
    for (const NamedRegion& region : named_regions(mesh)) {
        text << "g " << (region.region == 0 && !region.has_name ? "" : region.name) << "\n";
        for (const std::uint32_t f : region.faces) write_face(mesh.faces[f]);
    }
    return text.take();
}

}  // namespace vsplit

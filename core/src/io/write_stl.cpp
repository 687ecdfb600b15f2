#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <limits>

#include "base/byte_order.h"
#include "io/named_regions.h"
#include "io/stl_layout.h"
#include "io/text_writer.h"
#include "io/writers.h"

namespace vsplit {
namespace {

using Vec3f = Eigen::Vector3f;

/// What is too large for single precision becomes its largest number: the conversion itself is undefined there.
Vec3f to_single(const Vec3& point) {
    constexpr double kLargest = std::numeric_limits<float>::max();
    return point.cwiseMax(-kLargest).cwiseMin(kLargest).cast<float>();
}

/// A facet as STL has it: its unit normal (zero without an area), then its corners.
std::array<Vec3f, 4> facet(const TriangleMesh& mesh, const Triangle& face) {
    const Vec3& a = mesh.positions[face[0]];
    const Vec3& b = mesh.positions[face[1]];
    const Vec3& c = mesh.positions[face[2]];
    const Vec3 cross = (b - a).cross(c - a);
    const double length = cross.norm();
    const bool has_area = length > 0 && length <= std::numeric_limits<double>::max();
    return {has_area ? to_single(cross / length) : Vec3f::Zero().eval(), to_single(a), to_single(b), to_single(c)};
}

}  // namespace

std::string write_stl_binary(const TriangleMesh& mesh) {
    constexpr std::string_view kHeader = "binary STL by vsplit";  // must not begin with "solid"
    std::string bytes(kStlFacetsAt + mesh.faces.size() * kStlFacetBytes, '\0');
    std::copy(kHeader.begin(), kHeader.end(), bytes.begin());
    char* to = store(bytes.data() + kStlHeaderBytes, mesh.face_count());
    for (const Triangle& face : mesh.faces) {
        for (const Vec3f& row : facet(mesh, face)) {
            for (int axis = 0; axis < 3; ++axis) to = store(to, row[axis]);
        }
        // The attribute, which nobody agrees on, keeps the region.
        const std::uint32_t region = mesh.regions.empty() ? 0 : mesh.regions[static_cast<std::size_t>(&face - mesh.faces.data())];
        to = store(to, static_cast<std::uint16_t>(region));
    }
    return bytes;
}

std::string write_stl_ascii(const TriangleMesh& mesh) {
    constexpr std::size_t kFacetTextBytes = 260;
    TextWriter text(mesh.faces.size() * kFacetTextBytes);
    const auto point = [&](std::string_view before, const Vec3f& row) {
        text << before << row.x() << " " << row.y() << " " << row.z() << "\n";
    };
    const auto write_solid = [&](std::string_view name, const std::vector<std::uint32_t>& faces) {
        text << "solid " << name << "\n";
        for (const std::uint32_t f : faces) {
            const std::array<Vec3f, 4> rows = facet(mesh, mesh.faces[f]);
            point("  facet normal ", rows[0]);
            text << "    outer loop\n";
            for (std::size_t corner = 1; corner < rows.size(); ++corner) point("      vertex ", rows[corner]);
            text << "    endloop\n  endfacet\n";
        }
        text << "endsolid " << name << "\n";
    };
    const std::vector<NamedRegion> regions = named_regions(mesh);
    if (regions.empty()) write_solid("vsplit", {});
    for (const NamedRegion& region : regions) write_solid(mesh.regions.empty() ? "vsplit" : region.name, region.faces);
    return text.take();
}

}  // namespace vsplit

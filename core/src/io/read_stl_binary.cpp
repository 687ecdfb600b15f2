#include <array>
#include <string>

#include "base/byte_order.h"
#include "io/mesh_builder.h"
#include "io/read_error.h"
#include "io/readers.h"
#include "io/stl_layout.h"
#include "io/vertex_soup.h"

namespace vsplit {
namespace {

/// The number of facets, after comparing what the header says with what is there.
Expected<std::size_t> count_facets(std::span<const std::byte> bytes) {
    if (bytes.size() < kStlFacetsAt) {
        return read_error(Cause::kTruncatedInput, at_byte(bytes.size()),
                          "the file ends within the 84 bytes that begin a binary STL");
    }
    const std::uint64_t announced = load<std::uint32_t>(bytes.data() + kStlHeaderBytes);
    const std::size_t body = bytes.size() - kStlFacetsAt;
    const std::string counts = std::to_string(announced) + " facets of 50 bytes are announced, but the file holds " +
                               std::to_string(body / kStlFacetBytes);
    constexpr std::string_view kTakenFor = "; the bytes were taken for a binary STL";
    if (announced * kStlFacetBytes > body)
        return read_error(Cause::kTruncatedInput, at_byte(kStlHeaderBytes), counts + std::string(kTakenFor));
    if (announced * kStlFacetBytes < body) {
        return read_error(Cause::kMalformedInput, at_byte(kStlHeaderBytes),
                          counts + " and " + std::to_string(body % kStlFacetBytes) + " bytes" + std::string(kTakenFor));
    }
    return static_cast<std::size_t>(announced);
}

Vec3 load_point(const std::byte* from) {
    return {load<float>(from), load<float>(from + sizeof(float)), load<float>(from + 2 * sizeof(float))};
}

bool is_valid(const std::array<Vec3, 3>& corners) {
    bool valid = true;
    for (const Vec3& corner : corners) {
        for (int axis = 0; axis < 3; ++axis) valid = valid & is_valid_coordinate(corner[axis]);  // no branches
    }
    return valid;
}

/// What is wrong with the facet that begins at `byte`.
Error facet_error(const std::array<Vec3, 3>& corners, std::size_t facet, std::size_t byte) {
    for (const Vec3& corner : corners) {
        byte += kStlPointBytes;  // the normal is the first point
        const Status status = check_position(corner, at_byte(byte));
        if (status) continue;
        Error error = status.error();
        error.message += " (facet " + std::to_string(facet) + ")";
        return error;
    }
    return {};
}

/// The attributes as regions, where they are not all the same: some programs have colours there, vsplit has regions.
void read_attributes(std::span<const std::byte> bytes, TriangleMesh& mesh) {
    const auto attribute = [&](std::size_t facet) {
        return load<std::uint16_t>(bytes.data() + kStlFacetsAt + (facet + 1) * kStlFacetBytes - sizeof(std::uint16_t));
    };
    std::size_t facet = 0;
    while (facet < mesh.faces.size() && attribute(facet) == attribute(0)) ++facet;
    if (facet == mesh.faces.size()) return;
    for (facet = 0; facet < mesh.faces.size(); ++facet) mesh.regions.push_back(attribute(facet));
}

}  // namespace

Expected<TriangleMesh> read_stl_binary(std::span<const std::byte> bytes, std::uint32_t max_faces) {
    const Expected<std::size_t> facets = count_facets(bytes);
    if (!facets) return facets.error();
    if (const Status status = check_face_limit(*facets, max_faces, at_byte(kStlHeaderBytes)); !status) return status.error();

    VertexSoup soup;
    soup.reserve_faces(*facets);
    for (std::size_t facet = 0; facet < *facets; ++facet) {
        const std::size_t byte = kStlFacetsAt + facet * kStlFacetBytes;
        const std::byte* const corner = bytes.data() + byte + kStlPointBytes;
        const std::array<Vec3, 3> corners = {load_point(corner), load_point(corner + kStlPointBytes),
                                             load_point(corner + 2 * kStlPointBytes)};
        if (!is_valid(corners)) return facet_error(corners, facet, byte);
        soup.add_triangle(corners[0], corners[1], corners[2]);
    }
    TriangleMesh mesh = soup.take();
    read_attributes(bytes, mesh);
    return mesh;
}

}  // namespace vsplit

#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "io/read_error.h"
#include "mesh/coordinate.h"
#include "vsplit/base/expected.h"
#include "vsplit/mesh/triangle_mesh.h"

namespace vsplit {

/// The largest number of vertices: every index fits 32 bits, and one value is left to mean none.
inline constexpr std::uint64_t kMaxVertices = 0xFFFFFFFE;

/// LIMIT_EXCEEDED when `faces` are more than `max_faces`.
[[nodiscard]] Status check_face_limit(std::uint64_t faces, std::uint32_t max_faces, Place place);

/// LIMIT_EXCEEDED when `vertices` are more than three for each of `max_faces` faces, which is what a file needs that shares none;
/// or more than kMaxVertices.
[[nodiscard]] Status check_vertex_limit(std::uint64_t vertices, std::uint32_t max_faces, Place place);

/// TRUNCATED_INPUT when `count` elements (`what`: "vertices", "faces") of at least `least` bytes do not fit into `left` bytes:
/// what a header says is believed only as far as the file goes.
[[nodiscard]] Status check_announced(std::string_view what, std::uint64_t count, std::size_t least, std::size_t left,
                                     Place place);

/// INVALID_COORDINATE for what is_valid_coordinate refuses; `axis` is 0, 1 or 2.
[[nodiscard]] Error coordinate_error(std::size_t axis, double value, Place place);

/// The first coordinate's error, if there is one.
[[nodiscard]] Status check_position(const Vec3& position, Place place);

/// INDEX_OUT_OF_RANGE for a face that names vertex `index`, from 0, of `count`.
[[nodiscard]] Error index_error(std::int64_t index, std::uint64_t count, Place place);

/// Collects a mesh whose vertices are numbered in the file, and checks what every format must.
class MeshBuilder {
public:
    explicit MeshBuilder(std::uint32_t max_faces) : max_faces_(max_faces) {}

    /// Announced counts that have been checked against the bytes that are there. \return LIMIT_EXCEEDED.
    [[nodiscard]] Status reserve(std::uint64_t vertices, std::uint64_t faces, Place place);

    /// \return INVALID_COORDINATE, LIMIT_EXCEEDED.
    [[nodiscard]] Status add_vertex(const Vec3& position, Place place);

    /// Cuts a polygon into triangles (see cut_polygon), at the end where it names vertices that are not there yet.
    /// \return MALFORMED_INPUT for fewer than 3 corners, LIMIT_EXCEEDED. Indices are the caller's to check.
    [[nodiscard]] Status add_polygon(std::span<const std::uint32_t> corners, Place place);

    [[nodiscard]] std::uint32_t vertex_count() const { return mesh_.vertex_count(); }
    [[nodiscard]] std::uint32_t face_count() const { return mesh_.face_count(); }
    /// \pre all vertices that faces name are there. \return LIMIT_EXCEEDED for a polygon that takes too long to cut.
    [[nodiscard]] Expected<TriangleMesh> take();

private:
    struct Polygon {
        std::uint32_t first_face = 0;  // of the fan that its triangles are until it is cut
        std::uint32_t corners = 0;
        Place place;
    };

    [[nodiscard]] Status cut(const Polygon& polygon);

    std::vector<Polygon> waiting_;  // for vertices
    std::uint32_t max_faces_;
    TriangleMesh mesh_;
};

}  // namespace vsplit

#include "io/mesh_builder.h"

#include <algorithm>
#include <vector>

#include "io/cut_polygon.h"

namespace vsplit {

Status check_face_limit(std::uint64_t faces, std::uint32_t max_faces, Place place) {
    if (faces <= max_faces) return Done{};
    return read_error(Cause::kLimitExceeded, place,
                      std::to_string(faces) + " faces are more than the limit of " + std::to_string(max_faces));
}

Status check_vertex_limit(std::uint64_t vertices, std::uint32_t max_faces, Place place) {
    if (vertices > 3 * std::uint64_t{max_faces}) {
        return read_error(Cause::kLimitExceeded, place,
                          std::to_string(vertices) + " vertices are more than three for each face of the limit of " +
                              std::to_string(max_faces));
    }
    if (vertices <= kMaxVertices) return Done{};
    return read_error(Cause::kLimitExceeded, place,
                      std::to_string(vertices) + " vertices are more than the limit of " + std::to_string(kMaxVertices));
}

Status check_announced(std::string_view what, std::uint64_t count, std::size_t least, std::size_t left, Place place) {
    const std::uint64_t present = left / least;
    if (count <= present) return Done{};
    return read_error(Cause::kTruncatedInput, place,
                      std::to_string(count) + " " + std::string(what) + " are announced, but the " + std::to_string(left) +
                          " bytes that follow hold at most " + std::to_string(present));
}

Error coordinate_error(std::size_t axis, double value, Place place) {
    return read_error(Cause::kInvalidCoordinate, place,
                      std::string(1, "xyz"[axis]) + " of a vertex is " + to_text(value) +
                          "; finite numbers up to 1e15 in magnitude are accepted");
}

Status check_position(const Vec3& position, Place place) {
    for (int axis = 0; axis < 3; ++axis) {
        if (!is_valid_coordinate(position[axis])) return coordinate_error(static_cast<std::size_t>(axis), position[axis], place);
    }
    return Done{};
}

Error index_error(std::int64_t index, std::uint64_t count, Place place) {
    const std::string vertices = count == 0 ? "there are none" : "those of this file are 0 to " + std::to_string(count - 1);
    return read_error(Cause::kIndexOutOfRange, place, "a face names vertex " + std::to_string(index) + "; " + vertices);
}

Status MeshBuilder::reserve(std::uint64_t vertices, std::uint64_t faces, Place place) {
    if (const Status status = check_face_limit(faces, max_faces_, place); !status) return status.error();
    if (Status few = check_vertex_limit(vertices, max_faces_, place); !few) return few;
    mesh_.positions.reserve(vertices);
    mesh_.faces.reserve(faces);
    return Done{};
}

Status MeshBuilder::add_vertex(const Vec3& position, Place place) {
    if (const Status status = check_position(position, place); !status) return status.error();
    if (Status few = check_vertex_limit(mesh_.positions.size() + 1, max_faces_, place); !few) return few;
    mesh_.positions.push_back(position);
    return Done{};
}

Status MeshBuilder::add_polygon(std::span<const std::uint32_t> corners, Place place) {
    if (corners.size() < 3) {
        return read_error(Cause::kMalformedInput, place,
                          "a face has " + std::to_string(corners.size()) + " corners; 3 or more are needed");
    }
    if (const Status status = check_face_limit(mesh_.faces.size() + corners.size() - 2, max_faces_, place); !status)
        return status.error();
    const Polygon polygon{mesh_.face_count(), static_cast<std::uint32_t>(corners.size()), place};
    for (std::size_t corner = 2; corner < corners.size(); ++corner) {
        mesh_.faces.push_back({corners[0], corners[corner - 1], corners[corner]});
    }
    if (corners.size() == 3) return Done{};
    if (*std::max_element(corners.begin(), corners.end()) < vertex_count()) return cut(polygon);
    waiting_.push_back(polygon);
    return Done{};
}

Status MeshBuilder::cut(const Polygon& polygon) {
    return unfold_fan(mesh_.positions, std::span(mesh_.faces).subspan(polygon.first_face, polygon.corners - 2), polygon.place);
}

Expected<TriangleMesh> MeshBuilder::take() {
    for (const Polygon& polygon : waiting_) {
        if (Status done = cut(polygon); !done) return done.error();
    }
    return std::move(mesh_);
}

}  // namespace vsplit

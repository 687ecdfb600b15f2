#include "wire/base_mesh.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstring>
#include <string>
#include <utility>

#include "vsplit/mrr/base_codec.h"
#include "vsplit/mrr/record_block.h"
#include "wire/convert.h"

namespace vsplit::wire {
namespace {

static_assert(std::endian::native == std::endian::little, "positions and indices are copied as they lie in memory");
static_assert(sizeof(Vec3) == 24 && sizeof(Triangle) == 12, "no padding");

constexpr std::size_t kVerticesPerPart = kMaxPartBytes / sizeof(Vec3);
constexpr std::size_t kFacesPerPart = kMaxPartBytes / sizeof(Triangle);

std::size_t parts_of(std::size_t elements, std::size_t per_part) { return (elements + per_part - 1) / per_part; }

/// The bytes of elements [first, first + per_part) of `all`, as far as there are any.
template <class Element>
std::string bytes_of(const std::vector<Element>& all, std::size_t first, std::size_t per_part) {
    const std::size_t count = std::min(per_part, all.size() - first);
    std::string bytes(count * sizeof(Element), '\0');
    if (count > 0) std::memcpy(bytes.data(), static_cast<const void*>(all.data() + first), bytes.size());
    return bytes;
}

/// \pre bytes.size() is a multiple of the element's size.
template <class Element>
void append(const std::string& bytes, std::vector<Element>& all) {
    if (bytes.empty()) return;
    const std::size_t before = all.size();
    all.resize(before + bytes.size() / sizeof(Element));
    std::memcpy(static_cast<void*>(all.data() + before), bytes.data(), bytes.size());
}

Error base_error(Cause cause, const std::string& what) { return {cause, "base mesh: " + what, ""}; }

std::string counts(std::uint32_t vertices, std::uint32_t faces) {
    return std::to_string(vertices) + " vertices and " + std::to_string(faces) + " faces";
}

std::string counts(std::uint32_t vertices, std::uint32_t faces, std::uint32_t ghosts) {
    return counts(vertices, faces) + " with " + std::to_string(ghosts) + " ghosts";
}

}  // namespace

std::size_t base_mesh_parts(const TriangleMesh& mesh) {
    const std::size_t parts = parts_of(mesh.positions.size(), kVerticesPerPart) + parts_of(mesh.faces.size(), kFacesPerPart);
    return std::max<std::size_t>(parts, 1);  // an empty mesh is a part that says so
}

v1::BaseMesh base_mesh_part(const TriangleMesh& mesh, std::size_t part, std::uint32_t ghosts) {
    assert(part < base_mesh_parts(mesh));
    v1::BaseMesh proto;
    proto.set_vertices(mesh.vertex_count());
    proto.set_faces(mesh.face_count());
    proto.set_ghosts(ghosts);
    const std::size_t vertex_parts = parts_of(mesh.positions.size(), kVerticesPerPart);
    const std::size_t first_vertex = std::min(part * kVerticesPerPart, mesh.positions.size());
    const std::size_t first_face = part < vertex_parts ? 0 : (part - vertex_parts) * kFacesPerPart;
    proto.set_first_vertex(static_cast<std::uint32_t>(first_vertex));
    proto.set_first_face(static_cast<std::uint32_t>(first_face));
    if (part < vertex_parts) {
        proto.set_positions(bytes_of(mesh.positions, first_vertex, kVerticesPerPart));
    } else {
        proto.set_indices(bytes_of(mesh.faces, first_face, kFacesPerPart));
    }
    return proto;
}

PackedBaseMesh packed_base_mesh(const MultiresMesh& mrr, const PositionGrid& grid, std::string bytes, double max_error) {
    const std::uint32_t sum = crc32c(std::as_bytes(std::span(bytes)));
    return {std::move(bytes), sum, mrr.base.vertex_count(), mrr.base.face_count(), mrr.ghosts, grid, max_error};
}

std::size_t base_mesh_parts(const PackedBaseMesh& base) { return parts_of(base.bytes.size(), kMaxPartBytes); }

v1::BaseMesh base_mesh_part(const PackedBaseMesh& base, std::size_t part) {
    assert(part < base_mesh_parts(base));
    v1::BaseMesh proto;
    proto.set_vertices(base.vertices);
    proto.set_faces(base.faces);
    proto.set_ghosts(base.ghosts);
    proto.set_encoding(to_proto(base.grid.encoding()));
    proto.set_max_error(base.max_error);
    if (base.grid.encoding() == RecordEncoding::kQuantised) {
        proto.set_quantisation_bits(base.grid.bits());
        proto.mutable_origin()->set_x(base.grid.origin().x());
        proto.mutable_origin()->set_y(base.grid.origin().y());
        proto.mutable_origin()->set_z(base.grid.origin().z());
        proto.set_step(base.grid.step());
    }
    proto.set_packed_size(static_cast<std::uint32_t>(base.bytes.size()));
    proto.set_packed_offset(static_cast<std::uint32_t>(part * kMaxPartBytes));
    proto.set_packed(base.bytes.substr(part * kMaxPartBytes, kMaxPartBytes));
    proto.set_packed_crc32c(base.crc32c);
    return proto;
}

Status BaseMeshAssembler::begin(const v1::BaseMesh& part) {
    vertices_ = part.vertices();
    faces_ = part.faces();
    ghosts_ = part.ghosts();
    begun_ = true;
    max_error_ = part.max_error();
    first_record_ = part.first_record();
    splits_ = part.splits();
    const Expected<RecordEncoding> encoding = from_proto(part.encoding());
    if (!encoding) return base_error(Cause::kCorrupt, encoding.error().message);
    if (*encoding == RecordEncoding::kFloat32) grid_ = PositionGrid::float32();
    if (*encoding != RecordEncoding::kQuantised) return Done{};
    const Vec3 origin(part.origin().x(), part.origin().y(), part.origin().z());
    const Expected<PositionGrid> grid = PositionGrid::quantised(part.quantisation_bits(), origin, part.step());
    if (!grid) return base_error(Cause::kCorrupt, grid.error().message);
    grid_ = *grid;
    return Done{};
}

Status BaseMeshAssembler::add_packed(const v1::BaseMesh& part) {
    if (part.packed_offset() != packed_.size()) {
        return base_error(Cause::kOutOfOrder, "a part begins at byte " + std::to_string(part.packed_offset()) + ", expected is " +
                                                  std::to_string(packed_.size()));
    }
    if (part.packed().empty() || part.packed().size() > part.packed_size() - packed_.size()) {
        return base_error(Cause::kCorrupt, "a part of " + std::to_string(part.packed().size()) + " bytes where 1 to " +
                                               std::to_string(part.packed_size() - packed_.size()) + " are due");
    }
    packed_ += part.packed();
    return packed_.size() == part.packed_size() ? unpack(part) : Status(Done{});
}

Status BaseMeshAssembler::unpack(const v1::BaseMesh& part) {
    const auto bytes = std::as_bytes(std::span(packed_));
    if (crc32c(bytes) != part.packed_crc32c()) return base_error(Cause::kCorrupt, "its CRC-32C does not fit its bytes");
    Expected<TriangleMesh> mesh = unpack_base({bytes, vertices_, faces_, ghosts_}, grid_);
    if (!mesh) return mesh.error();
    mesh_ = *std::move(mesh);
    packed_ = {};
    complete_ = true;
    return Done{};
}

Status BaseMeshAssembler::check_counts(const v1::BaseMesh& part) {
    if (part.faces() > max_faces_ || part.vertices() > max_faces_) {
        return base_error(Cause::kLimitExceeded, counts(part.vertices(), part.faces()) + " announced; accepted are at most " +
                                                     std::to_string(max_faces_) + " of each");
    }
    if (!begun_) {
        if (Status begun = begin(part); !begun) return begun;
    }
    if (part.vertices() != vertices_ || part.faces() != faces_ || part.ghosts() != ghosts_) {
        return base_error(Cause::kCorrupt, "a part announces " + counts(part.vertices(), part.faces(), part.ghosts()) +
                                               ", the first announced " + counts(vertices_, faces_, ghosts_));
    }
    return Done{};
}

Status BaseMeshAssembler::check_order(const v1::BaseMesh& part) const {
    if (part.first_vertex() != mesh_.vertex_count()) {
        return base_error(Cause::kOutOfOrder, "a part begins at vertex " + std::to_string(part.first_vertex()) +
                                                  ", expected is " + std::to_string(mesh_.vertex_count()));
    }
    if (part.first_face() != mesh_.face_count()) {
        return base_error(Cause::kOutOfOrder, "a part begins at face " + std::to_string(part.first_face()) + ", expected is " +
                                                  std::to_string(mesh_.face_count()));
    }
    if (!part.indices().empty() && mesh_.vertex_count() + part.positions().size() / sizeof(Vec3) < vertices_) {
        return base_error(Cause::kOutOfOrder, "faces came before the last vertex");
    }
    return Done{};
}

Status BaseMeshAssembler::check_bytes(const v1::BaseMesh& part) const {
    const std::size_t positions = part.positions().size();
    const std::size_t indices = part.indices().size();
    if (positions % sizeof(Vec3) != 0 || indices % sizeof(Triangle) != 0) {
        return base_error(Cause::kCorrupt, std::to_string(positions) + " bytes of positions and " + std::to_string(indices) +
                                               " of indices; accepted are multiples of 24 and of 12");
    }
    if (positions / sizeof(Vec3) > vertices_ - mesh_.positions.size() ||
        indices / sizeof(Triangle) > faces_ - mesh_.faces.size()) {
        return base_error(Cause::kCorrupt, "more data than the announced " + counts(vertices_, faces_));
    }
    if (positions + indices == 0 && vertices_ + std::size_t{faces_} > 0) {
        return base_error(Cause::kCorrupt, "a part without data");  // would let a stream go on for ever
    }
    return Done{};
}

Status BaseMeshAssembler::add(const v1::BaseMesh& part) {
    if (complete()) return base_error(Cause::kOutOfOrder, "a part came after the last");
    if (Status ok = check_counts(part); !ok) return ok;
    if (grid_.encoding() != RecordEncoding::kFloat64) return add_packed(part);
    if (Status ok = check_order(part); !ok) return ok;
    if (Status ok = check_bytes(part); !ok) return ok;
    append(part.positions(), mesh_.positions);
    append(part.indices(), mesh_.faces);
    complete_ = mesh_.vertex_count() == vertices_ && mesh_.face_count() == faces_;
    return Done{};
}

TriangleMesh BaseMeshAssembler::take() {
    assert(complete());
    return std::exchange(mesh_, {});
}

}  // namespace vsplit::wire

#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "vsplit/base/expected.h"
#include "vsplit/mesh/length_unit.h"
#include "vsplit/mesh/triangle_mesh.h"

namespace vsplit {

struct ReadOptions;

/// One reader a format. All return the mesh as it stands in the file (STL: each vertex once, however often it is repeated), with
/// every coordinate valid, every index in range and at most `max_faces` faces; or the first error in the file.

[[nodiscard]] Expected<TriangleMesh> read_stl_binary(std::span<const std::byte> bytes, std::uint32_t max_faces);
[[nodiscard]] Expected<TriangleMesh> read_stl_ascii(std::span<const std::byte> bytes, std::uint32_t max_faces);
[[nodiscard]] Expected<TriangleMesh> read_obj(std::span<const std::byte> bytes, std::uint32_t max_faces);
[[nodiscard]] Expected<TriangleMesh> read_ply(std::span<const std::byte> bytes, std::uint32_t max_faces);
[[nodiscard]] Expected<TriangleMesh> read_off(std::span<const std::byte> bytes, std::uint32_t max_faces);
[[nodiscard]] Expected<TriangleMesh> read_msh(std::span<const std::byte> bytes, std::uint32_t max_faces);
[[nodiscard]] Expected<TriangleMesh> read_inp(std::span<const std::byte> bytes, std::uint32_t max_faces);
[[nodiscard]] Expected<TriangleMesh> read_bdf(std::span<const std::byte> bytes, std::uint32_t max_faces);
[[nodiscard]] Expected<TriangleMesh> read_vtk(std::span<const std::byte> bytes, std::uint32_t max_faces);
[[nodiscard]] Expected<TriangleMesh> read_vtu(std::span<const std::byte> bytes, std::uint32_t max_faces);
/// `unit` becomes the file's.
[[nodiscard]] Expected<TriangleMesh> read_3mf(std::span<const std::byte> bytes, const ReadOptions& options,
                                              std::optional<LengthUnit>& unit);

}  // namespace vsplit

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "vsplit/mesh/triangle_mesh.h"
#include "vsplit/method/method_options.h"
#include "vsplit/mrr/multires_mesh.h"

namespace vsplit::service {

// What things take in memory, bytes.

[[nodiscard]] std::uint64_t memory_of(const TriangleMesh& mesh);
[[nodiscard]] std::uint64_t memory_of(const MultiresMesh& mrr);

/// What a request holds: arrays may be as large as a mesh.
[[nodiscard]] std::uint64_t memory_of(const MethodOptions& options);

/// How many faces a file of this size has at most, unless it has polygons of many corners, or names them twice.
[[nodiscard]] std::uint64_t usual_faces(std::span<const std::byte> file);

/// What reading takes while it goes on, the mesh included; a repair takes more.
[[nodiscard]] std::uint64_t memory_to_read(std::uint64_t faces, bool repair);

/// What is taken while the quality of a mesh is measured, or its features are looked for, beside the mesh.
[[nodiscard]] std::uint64_t memory_to_measure(std::uint64_t faces);

/// What writing a file takes while it goes on, beside the mesh. `order` of its elements: 1 or 2.
[[nodiscard]] std::uint64_t memory_to_write(std::uint64_t faces, unsigned order);

/// What a method takes while it runs, the result included, for `faces` after subdivision.
[[nodiscard]] std::uint64_t memory_to_simplify(std::uint64_t faces);

}  // namespace vsplit::service

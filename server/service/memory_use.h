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

/// What reading a file takes while it goes on, the mesh included; a repair takes more.
[[nodiscard]] std::uint64_t memory_to_read(std::span<const std::byte> file, bool repair);
[[nodiscard]] std::uint64_t memory_to_read(std::uint64_t faces, bool repair);

/// What a method takes while it runs, the result included, for `faces` after subdivision.
[[nodiscard]] std::uint64_t memory_to_simplify(std::uint64_t faces);

}  // namespace vsplit::service

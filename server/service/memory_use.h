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

/// Of reading a file, with a repair or not.
struct ReadingEstimate {
    std::uint64_t faces = 0;         ///< what a file of this size usually has at most; it may have polygons of many corners
    std::uint64_t bytes_a_face = 0;  ///< what reading takes while it goes on, the mesh included
};
[[nodiscard]] ReadingEstimate estimate_reading(std::span<const std::byte> file, bool repair);

/// What a repair of a mesh takes, or the removal of features, while it goes on, the result included.
[[nodiscard]] std::uint64_t memory_to_repair(std::uint64_t faces);

/// What is taken while the quality of a mesh is measured, or its features are looked for, beside the mesh.
[[nodiscard]] std::uint64_t memory_to_measure(std::uint64_t faces);

/// What writing a file takes while it goes on, beside the mesh. `order` of its elements: 1 or 2.
[[nodiscard]] std::uint64_t memory_to_write(std::uint64_t faces, unsigned order);

/// What a method takes while it runs, the result included, for `faces` after subdivision.
[[nodiscard]] std::uint64_t memory_to_simplify(std::uint64_t faces);

}  // namespace vsplit::service

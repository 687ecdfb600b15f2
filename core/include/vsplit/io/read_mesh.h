#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>

#include "vsplit/base/expected.h"
#include "vsplit/io/mesh_format.h"
#include "vsplit/mesh/triangle_mesh.h"
#include "vsplit/mesh/weld.h"

namespace vsplit {

struct ReadOptions {
    std::optional<MeshFormat> format{};    ///< told from the bytes when empty; when given, bytes of another format are an error
    double weld = 0;                       ///< length, model units, >= 0; 0 merges exactly equal vertices. See `weld`.
    std::uint32_t max_faces = 50'000'000;  ///< LIMIT_EXCEEDED beyond; checked against headers before memory is taken
};

/// A mesh as it was in the file, welded. Polygons are cut into fans of triangles.
struct ReadResult {
    TriangleMesh mesh;
    MeshFormat format{};
    WeldCounts weld;
};

/// Reads STL (binary, ASCII), OBJ, PLY (ASCII, little- and big-endian), OFF, MSH (2.2, 4.1), INP, BDF, VTK or VTU from memory and
/// welds it. Of what solvers mesh, triangles and quadrilaterals are read, by their corners where they have mid-side nodes.
///
/// Attributes other than positions, faces and regions are skipped. Nothing is repaired: a wrong byte is an error that says where
/// (line for text, byte offset for binary), what was read and what was expected.
/// \return EMPTY_INPUT, UNKNOWN_FORMAT, TRUNCATED_INPUT, MALFORMED_INPUT, INVALID_COORDINATE (NaN, infinite, or beyond 1e15 in
///         magnitude), INDEX_OUT_OF_RANGE, LIMIT_EXCEEDED, UNSUPPORTED (e.g. binary OFF, a mesh of solids), INVALID_OPTION
///         (weld).
/// Complexity: O(bytes). Memory: the mesh, and 20 bytes a vertex while welding.
[[nodiscard]] Expected<ReadResult> read_mesh(std::span<const std::byte> bytes, const ReadOptions& options);

/// Maps the file into memory and reads it. FILE_ACCESS or NOT_FOUND when it cannot be opened.
[[nodiscard]] Expected<ReadResult> read_mesh_file(const std::filesystem::path& path, const ReadOptions& options);

}  // namespace vsplit

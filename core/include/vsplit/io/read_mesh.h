#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>

#include "vsplit/base/expected.h"
#include "vsplit/io/mesh_format.h"
#include "vsplit/mesh/length_unit.h"
#include "vsplit/mesh/triangle_mesh.h"
#include "vsplit/mesh/weld.h"

namespace vsplit {

struct ReadOptions {
    std::optional<MeshFormat> format{};  ///< told from the bytes when empty; when given, bytes of another format are an error
    double weld = 0;                     ///< length, model units, >= 0; 0 merges exactly equal vertices. See `weld`.
    /// LIMIT_EXCEEDED beyond, and beyond three vertices for each; checked against headers before memory is taken.
    std::uint32_t max_faces = 50'000'000;
    std::optional<LengthUnit> unit{};  ///< of the file's lengths, where it does not say it
};

/// A mesh as it was in the file, welded. Polygons are cut into triangles, without folding.
struct ReadResult {
    TriangleMesh mesh;
    MeshFormat format{};
    WeldCounts weld;
    std::optional<LengthUnit> unit{};  ///< what the file says, else what the caller stated; empty: nobody did
};

/// Reads STL (binary, ASCII), OBJ, PLY (ASCII, little- and big-endian), OFF, MSH (2.2, 4.1), INP, BDF, VTK, VTU or 3MF from
/// memory and welds it. Of them 3MF alone says its unit. Of what solvers mesh, triangles and quadrilaterals are read, by their
/// corners where they have mid-side nodes.
///
/// Attributes other than positions, faces and regions are skipped. Nothing is repaired: a wrong byte is an error that says where
/// (line for text, byte offset for binary), what was read and what was expected.
/// \return EMPTY_INPUT, UNKNOWN_FORMAT, TRUNCATED_INPUT, MALFORMED_INPUT, INVALID_COORDINATE (NaN, infinite, or beyond 1e15 in
///         magnitude), INDEX_OUT_OF_RANGE, LIMIT_EXCEEDED, UNSUPPORTED (e.g. binary OFF, a mesh of solids), INVALID_OPTION
///         (weld; unit, where the file says another).
/// Complexity: O(bytes). Memory: the mesh, and 20 bytes a vertex while welding.
[[nodiscard]] Expected<ReadResult> read_mesh(std::span<const std::byte> bytes, const ReadOptions& options);

/// How many bytes a file comes to that is read, unpacked: what it claims itself where it is 3MF, which is a zip archive, else its
/// own. For who sets memory aside. O(size of the archive's table).
[[nodiscard]] std::uint64_t unpacked_size(std::span<const std::byte> bytes);

/// Maps the file into memory and reads it. Where neither the options nor the bytes tell the format, its name does (see
/// format_where_bytes_do_not_tell). \return as read_mesh; FILE_ACCESS or NOT_FOUND when it cannot be opened.
[[nodiscard]] Expected<ReadResult> read_mesh_file(const std::filesystem::path& path, const ReadOptions& options);

}  // namespace vsplit

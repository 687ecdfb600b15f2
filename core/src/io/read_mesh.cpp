#include "vsplit/io/read_mesh.h"

#include <algorithm>
#include <string>

#include "base/mapped_file.h"
#include "io/readers.h"
#include "io/zip_reader.h"
#include "mesh/drop_unused.h"

namespace vsplit {
namespace {

/// Formats that a caller need not tell apart, as the bytes do.
MeshFormat family_of(MeshFormat format) {
    switch (format) {
        case MeshFormat::kStlAscii:
            return MeshFormat::kStlBinary;
        case MeshFormat::kPlyAscii:
            return MeshFormat::kPlyBinary;
        case MeshFormat::kMshAscii:
        case MeshFormat::kMsh2:
        case MeshFormat::kMsh2Ascii:
            return MeshFormat::kMsh;
        case MeshFormat::kVtkAscii:
            return MeshFormat::kVtk;
        default:
            return format;
    }
}

Expected<MeshFormat> choose_format(std::span<const std::byte> bytes, std::optional<MeshFormat> asked) {
    const std::optional<MeshFormat> detected = detect_format(bytes);
    if (!detected && !asked) {
        return Error{
            Cause::kUnknownFormat,
            "byte 0: the bytes are of no format that is read: STL (binary, ASCII), OBJ, PLY (binary, ASCII), OFF, MSH, INP, "
            "BDF, VTK, VTU, 3MF",
            ""};
    }
    if (!detected) return *asked;
    if (asked && family_of(*asked) != family_of(*detected)) {
        return Error{Cause::kMalformedInput,
                     "byte 0: the bytes are " + std::string(format_name(*detected)) + ", not " +
                         std::string(format_name(*asked)) + " as asked; leave the format empty to have it told from the bytes",
                     "format"};
    }
    return *detected;
}

/// `unit` becomes what the file says, where it says one.
Expected<TriangleMesh> read_as(MeshFormat format, std::span<const std::byte> bytes, const ReadOptions& options,
                               std::optional<LengthUnit>& unit) {
    const std::uint32_t max_faces = options.max_faces;
    switch (format) {
        case MeshFormat::kStlBinary:
            return read_stl_binary(bytes, max_faces);
        case MeshFormat::kStlAscii:
            return read_stl_ascii(bytes, max_faces);
        case MeshFormat::kObj:
            return read_obj(bytes, max_faces);
        case MeshFormat::kPlyBinary:
        case MeshFormat::kPlyAscii:
            return read_ply(bytes, max_faces);
        case MeshFormat::kMsh:
        case MeshFormat::kMshAscii:
        case MeshFormat::kMsh2:
        case MeshFormat::kMsh2Ascii:
            return read_msh(bytes, max_faces);
        case MeshFormat::kInp:
            return read_inp(bytes, max_faces);
        case MeshFormat::kBdf:
            return read_bdf(bytes, max_faces);
        case MeshFormat::kVtk:
        case MeshFormat::kVtkAscii:
            return read_vtk(bytes, max_faces);
        case MeshFormat::kVtu:
            return read_vtu(bytes, max_faces);
        case MeshFormat::k3mf:
            return read_3mf(bytes, options, unit);
        case MeshFormat::kOff:
            break;
    }
    return read_off(bytes, max_faces);
}

/// The STL readers have merged equal vertices on the way: three a face became the mesh's.
Expected<WeldCounts> weld_read(TriangleMesh& mesh, MeshFormat format, double tolerance) {
    const bool merged = family_of(format) == MeshFormat::kStlBinary;
    const std::uint64_t before = merged ? 3 * std::uint64_t{mesh.face_count()} - mesh.vertex_count() : 0;
    Expected<WeldCounts> counts = merged && tolerance == 0 ? drop_unused(mesh) : weld(mesh, tolerance);
    if (!counts) return counts;
    counts->merged_vertices += static_cast<std::uint32_t>(before);
    counts->unused_sets = drop_unused_sets(mesh);
    return counts;
}

}  // namespace

Expected<ReadResult> read_mesh(std::span<const std::byte> bytes, const ReadOptions& options) {
    if (bytes.empty()) return Error{Cause::kEmptyInput, "byte 0: the file is empty", ""};
    const Expected<MeshFormat> format = choose_format(bytes, options.format);
    if (!format) return format.error();
    std::optional<LengthUnit> told;
    Expected<TriangleMesh> mesh = read_as(*format, bytes, options, told);
    if (!mesh) return mesh.error();
    const Expected<std::optional<LengthUnit>> unit = agreed_unit(told, options.unit);
    if (!unit) return unit.error();
    if (mesh->faces.empty()) {
        return Error{Cause::kEmptyInput,
                     "the file has " + std::to_string(mesh->vertex_count()) + " vertices, but no face; it was read as " +
                         std::string(format_name(*format)),
                     ""};
    }
    const std::uint32_t faces = mesh->face_count();
    const Expected<WeldCounts> counts = weld_read(*mesh, *format, options.weld);
    if (!counts) return counts.error();
    if (mesh->faces.empty()) {
        return Error{Cause::kEmptyInput,
                     "each of the file's " + std::to_string(faces) + " faces has two equal corners after the weld; none is left",
                     ""};
    }
    return ReadResult{*std::move(mesh), *format, *counts, *unit};
}

std::uint64_t unpacked_size(std::span<const std::byte> bytes) {
    if (detect_format(bytes) != MeshFormat::k3mf) return bytes.size();
    const Expected<ZipReader> archive = ZipReader::open(bytes);
    return archive ? std::max<std::uint64_t>(bytes.size(), archive->unpacked_size()) : bytes.size();
}

Expected<ReadResult> read_mesh_file(const std::filesystem::path& path, const ReadOptions& options) {
    const Expected<MappedFile> file = MappedFile::open(path);
    if (!file) return file.error();
    ReadOptions chosen = options;
    if (!chosen.format) chosen.format = format_where_bytes_do_not_tell(file->bytes(), path.filename().string());
    return read_mesh(file->bytes(), chosen);
}

}  // namespace vsplit

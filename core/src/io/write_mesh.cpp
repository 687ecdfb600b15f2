#include "vsplit/io/write_mesh.h"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>

#include "base/write_file.h"
#include "io/elements.h"
#include "io/named_regions.h"
#include "io/writers.h"
#include "vsplit/io/second_order.h"

namespace vsplit {
namespace {

/// What fits an attribute of STL, a tag of MSH with as many of sets behind it, a property of Nastran with one more for none.
std::uint32_t largest_region(MeshFormat format) {
    constexpr std::uint32_t kLargestTag = 2'000'000'000, kLargestProperty = 99'999'998;
    switch (format) {
        case MeshFormat::kStlBinary:
            return std::numeric_limits<std::uint16_t>::max();
        case MeshFormat::kMsh:
        case MeshFormat::kMshAscii:
        case MeshFormat::kMsh2:
        case MeshFormat::kMsh2Ascii:
            return kLargestTag;
        case MeshFormat::kBdf:
            return kLargestProperty;
        default:
            return std::numeric_limits<std::uint32_t>::max();
    }
}

/// Formats that name the kind of an element; VTU where no other is asked for.
std::string write_elements(const Elements& elements, MeshFormat format) {
    switch (format) {
        case MeshFormat::kMsh:
        case MeshFormat::kMshAscii:
            return write_msh_4(elements, format == MeshFormat::kMshAscii);
        case MeshFormat::kMsh2:
        case MeshFormat::kMsh2Ascii:
            return write_msh_2(elements, format == MeshFormat::kMsh2Ascii);
        case MeshFormat::kInp:
            return write_inp(elements);
        case MeshFormat::kBdf:
            return write_bdf(elements);
        case MeshFormat::kVtk:
        case MeshFormat::kVtkAscii:
            return write_vtk(elements, format == MeshFormat::kVtkAscii);
        default:
            return write_vtu(elements);
    }
}

}  // namespace

std::string write_mesh(const TriangleMesh& any_regions, MeshFormat format, std::optional<LengthUnit> unit) {
    const std::optional<TriangleMesh> small = with_regions_up_to(largest_region(format), any_regions);
    const TriangleMesh& mesh = small ? *small : any_regions;
    switch (format) {
        case MeshFormat::kStlBinary:
            return write_stl_binary(mesh);
        case MeshFormat::kStlAscii:
            return write_stl_ascii(mesh);
        case MeshFormat::kObj:
            return write_obj(mesh);
        case MeshFormat::kPlyBinary:
            return write_ply_binary(mesh);
        case MeshFormat::kPlyAscii:
            return write_ply_ascii(mesh);
        case MeshFormat::kOff:
            return write_off(mesh);
        case MeshFormat::k3mf:
            return write_3mf(mesh, unit);
        default:
            break;
    }
    return write_elements(Elements(mesh), format);
}

Status check_unit(MeshFormat format, std::optional<LengthUnit> unit, std::optional<LengthUnit> asked) {
    if (unit) return Done{};
    const char* const remedy = "; read the mesh again and state its unit";
    if (asked) {
        return Error{Cause::kInvalidOption,
                     "lengths cannot be converted to " + std::string(unit_symbol(*asked)) +
                         ", as the unit of the mesh is not known" + remedy,
                     "unit"};
    }
    if (format != MeshFormat::k3mf) return Done{};
    return Error{Cause::kInvalidOption, std::string("a 3mf file says its unit, and that of the mesh is not known") + remedy,
                 "unit"};
}

bool has_second_order(MeshFormat format) {
    constexpr std::array kFormats{MeshFormat::kMsh,       MeshFormat::kMshAscii, MeshFormat::kMsh2,
                                  MeshFormat::kMsh2Ascii, MeshFormat::kInp,      MeshFormat::kBdf,
                                  MeshFormat::kVtk,       MeshFormat::kVtkAscii, MeshFormat::kVtu};
    return std::find(kFormats.begin(), kFormats.end(), format) != kFormats.end();
}

Expected<std::string> write_second_order(const TriangleMesh& mesh, const MidsideNodes& nodes, MeshFormat format) {
    const std::optional<TriangleMesh> small = with_regions_up_to(largest_region(format), mesh);
    if (has_second_order(format)) return write_elements(Elements(small ? *small : mesh, &nodes), format);
    return Error{
        Cause::kUnsupported,
        std::string(format_name(format)) + " has no triangles of six nodes; accepted with order 2 are msh, inp, bdf, vtk and vtu",
        "order"};
}

Status write_second_order_file(const TriangleMesh& mesh, const MidsideNodes& nodes, MeshFormat format,
                               const std::filesystem::path& path) {
    const Expected<std::string> bytes = write_second_order(mesh, nodes, format);
    if (!bytes) return bytes.error();
    return write_file(path, *bytes);
}

Status write_mesh_file(const TriangleMesh& mesh, MeshFormat format, const std::filesystem::path& path,
                       std::optional<LengthUnit> unit) {
    return write_file(path, write_mesh(mesh, format, unit));
}

}  // namespace vsplit

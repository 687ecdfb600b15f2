#include "vsplit/io/write_mesh.h"

#include "base/write_file.h"
#include "io/writers.h"

namespace vsplit {

std::string write_mesh(const TriangleMesh& mesh, MeshFormat format) {
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
        case MeshFormat::kMsh:
        case MeshFormat::kMshAscii:
            return write_msh_4(mesh, format == MeshFormat::kMshAscii);
        case MeshFormat::kMsh2:
        case MeshFormat::kMsh2Ascii:
            return write_msh_2(mesh, format == MeshFormat::kMsh2Ascii);
        case MeshFormat::kInp:
            return write_inp(mesh);
        case MeshFormat::kBdf:
            return write_bdf(mesh);
        case MeshFormat::kVtk:
        case MeshFormat::kVtkAscii:
            return write_vtk(mesh, format == MeshFormat::kVtkAscii);
        case MeshFormat::kVtu:
            return write_vtu(mesh);
        case MeshFormat::kOff:
            break;
    }
    return write_off(mesh);
}

Status write_mesh_file(const TriangleMesh& mesh, MeshFormat format, const std::filesystem::path& path) {
    return write_file(path, write_mesh(mesh, format));
}

}  // namespace vsplit

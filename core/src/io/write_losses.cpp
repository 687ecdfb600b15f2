#include "vsplit/io/write_losses.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "io/named_regions.h"

namespace vsplit {
namespace {

enum class Names { kNone, kOneARegion, kAll };

Names names_in(MeshFormat format) {
    switch (format) {
        case MeshFormat::kStlBinary:
        case MeshFormat::kPlyBinary:
        case MeshFormat::kPlyAscii:
        case MeshFormat::kOff:
        case MeshFormat::kVtk:
        case MeshFormat::kVtkAscii:
        case MeshFormat::kVtu:
            return Names::kNone;
        case MeshFormat::kStlAscii:
        case MeshFormat::kObj:
        case MeshFormat::kMsh2:
        case MeshFormat::kMsh2Ascii:
        case MeshFormat::kBdf:
            return Names::kOneARegion;
        case MeshFormat::kMsh:
        case MeshFormat::kMshAscii:
        case MeshFormat::kInp:
        case MeshFormat::k3mf:
            break;
    }
    return Names::kAll;
}

}  // namespace

std::vector<std::string> sets_left_out(const TriangleMesh& mesh, MeshFormat format) {
    std::vector<std::string> names;
    const Names has = names_in(format);
    if (has == Names::kAll || mesh.sets.empty()) return names;
    std::set<std::string> written;
    if (has == Names::kOneARegion) {
        for (const NamedRegion& region : named_regions(mesh)) {
            if (region.has_name) written.insert(region.name);
        }
    }
    for (const FaceSet& set : sets_with_faces(mesh)) {
        if (written.count(set.name) == 0) names.push_back(set.name);
    }
    return names;
}

Rounding rounding_of(const TriangleMesh& mesh, MeshFormat format) {
    Rounding rounding;
    if (format != MeshFormat::kStlBinary && format != MeshFormat::kStlAscii) return rounding;
    double largest = 0, shortest = std::numeric_limits<double>::infinity();
    for (const Vec3& position : mesh.positions) largest = std::max(largest, position.cwiseAbs().maxCoeff());
    for (const Triangle& t : mesh.faces) {
        for (std::size_t corner = 0; corner < 3; ++corner) {
            const double square = (mesh.positions[t[(corner + 1) % 3]] - mesh.positions[t[corner]]).squaredNorm();
            if (square > 0) shortest = std::min(shortest, square);
        }
    }
    rounding.step = largest * std::numeric_limits<float>::epsilon();
    rounding.shortest_edge = std::sqrt(shortest);
    return rounding;
}

}  // namespace vsplit

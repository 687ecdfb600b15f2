#include "shapes/improve_patch.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>

#include "mesh/half_edges.h"
#include "vsplit/method/improve.h"
#include "vsplit/mrr/progressive_mesh.h"
#include "vsplit/quality/stretch.h"

namespace vsplit {
namespace {

constexpr double kGoodStretch = 0.4;  // where the search for a size ends
constexpr double kStep = 0.7;         // from the size asked for down, as short edges of the border may need smaller faces
constexpr int kMostTries = 12;
constexpr std::size_t kResolutions = 40;  // that are looked at in one try

double least_stretch(const TriangleMesh& mesh) {
    double least = 1;
    for (const Triangle& t : mesh.faces)
        least = std::min(least, stretch(mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]));
    return least;
}

struct BorderEdges {
    double mean = 0;
    double longest = 0;
};

BorderEdges measure_border(const Patch& patch) {
    BorderEdges edges;
    for (std::uint32_t v = 0; v < patch.border; ++v) {
        const double length = (patch.mesh.positions[(v + 1) % patch.border] - patch.mesh.positions[v]).norm();
        edges.mean += length / patch.border;
        edges.longest = std::max(edges.longest, length);
    }
    return edges;
}

/// Border edges of `mesh`, as pairs of vertices.
std::vector<std::array<std::uint32_t, 2>> border_of(const TriangleMesh& mesh) {
    std::vector<std::array<std::uint32_t, 2>> border;
    const std::vector<HalfEdge> twins = half_edge_twins(mesh);
    for (HalfEdge h = 0; h < twins.size(); ++h) {
        if (twins[h] == kNone) border.push_back({origin(mesh, h), origin(mesh, next(h))});
    }
    return border;
}

/// `made` with the vertices of `patch` first; none where the borders differ.
std::optional<Patch> renumbered(const TriangleMesh& made, const Patch& patch) {
    std::map<std::array<double, 3>, std::uint32_t> places;
    const auto key = [](const Vec3& p) { return std::array<double, 3>{p.x(), p.y(), p.z()}; };
    for (std::uint32_t v = 0; v < patch.border; ++v) places.emplace(key(patch.mesh.positions[v]), v);
    std::vector<std::uint32_t> number(made.positions.size(), kNone);
    const auto border = border_of(made);
    if (border.size() != patch.border) return {};
    for (const auto& [from, to] : border) {
        const auto a = places.find(key(made.positions[from])), b = places.find(key(made.positions[to]));
        if (a == places.end() || b == places.end()) return {};
        const std::uint32_t following = a->second + 1 < patch.border ? a->second + 1 : 0;
        if (b->second != following) return {};
        number[from] = a->second;
    }
    Patch result{{patch.mesh.positions, made.faces}, patch.border};
    for (std::uint32_t v = 0; v < made.vertex_count(); ++v) {
        if (number[v] != kNone) continue;
        number[v] = result.mesh.vertex_count();
        result.mesh.positions.push_back(made.positions[v]);
    }
    for (Triangle& t : result.mesh.faces) {
        for (std::uint32_t& corner : t) corner = number[corner];
    }
    return result;
}

double largest_face(const TriangleMesh& mesh) {
    double most = 0;
    for (const Triangle& t : mesh.faces)
        most = std::max(most, face_size(mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]));
    return most;
}

/// Of some resolutions from the coarsest to the one that was made, evenly apart, the first whose faces are as good as those of
/// the latter, or good, and no larger than asked: their mean size is the nearest to that.
TriangleMesh coarsest_good(const MethodResult& made, double largest) {
    const std::size_t last = made.mrr.level_for(made.faces);
    TriangleMesh finest = mesh_at(made.mrr, last);
    const double least = std::min(kGoodStretch, least_stretch(finest));
    const double most = std::max(largest, largest_face(finest));
    const std::size_t step = last / kResolutions + 1;
    for (std::size_t level = 0; level < last; level += step) {
        TriangleMesh mesh = mesh_at(made.mrr, level);
        if (largest_face(mesh) <= most && least_stretch(mesh) >= least) return mesh;
    }
    return finest;
}

std::optional<Patch> improved(const Patch& patch, double subdivision_size, double largest) {
    ImproveOptions options;
    options.subdivision_size = subdivision_size;
    options.freeze_boundary = true;
    options.min_stretch = kGoodStretch;
    options.sizing.emplace();
    options.sizing->max_size = largest;
    const ExecutionContext context({}, 1);
    const Expected<MethodResult> made = improve(patch.mesh, options, {}, context);
    if (!made) return {};
    return renumbered(coarsest_good(*made, largest), patch);
}

}  // namespace

Patch improve_patch(const Patch& patch, double size) {
    const BorderEdges edges = measure_border(patch);
    Patch best = patch;
    double stretch_of_best = least_stretch(patch.mesh);
    double aim = size;
    for (int i = 0; i < kMostTries && stretch_of_best < kGoodStretch; ++i, aim *= kStep) {
        if (i > 0 && aim < edges.mean / 2) break;
        std::optional<Patch> tried = improved(patch, aim, std::max(size, edges.longest));
        if (!tried) continue;
        const double least = least_stretch(tried->mesh);
        if (least <= stretch_of_best) continue;
        best = *std::move(tried);
        stretch_of_best = least;
    }
    return best;
}

}  // namespace vsplit

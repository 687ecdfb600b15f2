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

constexpr double kGoodStretch = 0.31;  // where the search for a size ends: 0.3 with a margin, as what has more is smaller
constexpr double kStep = 0.7;          // from the size asked for down, as short edges of the border may need smaller faces
constexpr int kMostTries = 12;
constexpr double kOver = 1 / 0.95;  // sizing keeps so far under its bound, for places between vertices; a patch needs it not

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

bool is_within(const TriangleMesh& mesh, double largest) {
    return std::all_of(mesh.faces.begin(), mesh.faces.end(), [&](const Triangle& t) {
        return face_size(mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]) <= largest;
    });
}

std::optional<Patch> improved(const Patch& patch, double subdivision_size, double largest) {
    ImproveOptions options;
    options.subdivision_size = subdivision_size;
    options.freeze_boundary = true;
    options.min_stretch = kGoodStretch;
    options.min_mean_stretch = 0;  // short edges of a border make stretched faces; the least one counts
    options.sizing.emplace();
    options.sizing->max_size = largest;
    const ExecutionContext context({}, 1);
    const Expected<MethodResult> made = improve(patch.mesh, options, {}, context);
    if (!made) return {};
    return renumbered(mesh_at(made->mrr, made->mrr.level_for(made->faces)), patch);
}

}  // namespace

Patch improve_patch(const Patch& patch, double size) {
    const BorderEdges edges = measure_border(patch);
    Patch best = patch;
    const double largest = std::max(size, edges.longest);
    double stretch_of_best = is_within(patch.mesh, largest) ? least_stretch(patch.mesh) : 0;
    double aim = std::min(size, bounding_box(patch.mesh).diagonal());  // what is larger divides nothing
    for (int i = 0; i < kMostTries && stretch_of_best < kGoodStretch; ++i, aim *= kStep) {
        if (i > 0 && aim < edges.mean / 2) break;
        std::optional<Patch> tried = improved(patch, aim, kOver * largest);
        if (tried && !is_within(tried->mesh, largest)) tried = improved(patch, aim, largest);
        if (!tried) continue;
        const double least = least_stretch(tried->mesh);
        if (least <= stretch_of_best) continue;
        best = *std::move(tried);
        stretch_of_best = least;
    }
    return best;
}

}  // namespace vsplit

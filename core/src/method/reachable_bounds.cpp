#include "method/reachable_bounds.h"

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include "base/number_text.h"
#include "mesh/boundary_loops.h"
#include "mesh/disjoint_sets.h"
#include "vsplit/method/control.h"

namespace vsplit {
namespace {

Error out_of_reach(const char* field, const std::string& was, const std::string& accepted) {
    return {Cause::kInvalidOption, std::string(field) + " is " + was + "; accepted is " + accepted, field};
}

/// A part of the mesh that edges join.
struct Component {
    std::uint64_t vertices = 0;
    std::uint64_t faces = 0;
    BoundingBox box{};
    bool closed = true;

    /// 1 - (vertices - edges + faces) / 2, of a closed one, which has 3 edges for 2 faces.
    [[nodiscard]] std::uint64_t genus() const { return (faces / 2 + 2 - vertices) / 2; }
};

std::vector<Component> components_of(const TriangleMesh& mesh) {
    DisjointSets sets(mesh.positions.size());
    for (const Triangle& t : mesh.faces) {
        sets.join(t[0], t[1]);
        sets.join(t[0], t[2]);
    }
    std::vector<Component> all;
    std::vector<std::uint32_t> number(mesh.positions.size(), kNone);  // of a vertex that a face has
    for (const Triangle& t : mesh.faces) {
        const std::uint32_t root = sets.find(t[0]);
        if (number[root] == kNone) {
            number[root] = static_cast<std::uint32_t>(all.size());
            all.emplace_back();
        }
        for (const std::uint32_t v : t) number[v] = number[root];
        all[number[root]].faces += 1;
    }
    for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) {
        if (number[v] == kNone) continue;
        Component& component = all[number[v]];
        component.vertices += 1;
        component.box.min = component.box.min.cwiseMin(mesh.positions[v]);
        component.box.max = component.box.max.cwiseMax(mesh.positions[v]);
    }
    for (const std::vector<HalfEdge>& loop : boundary_loops(mesh)) all[number[origin(mesh, loop.front())]].closed = false;
    return all;
}

Status check_min_size(const std::vector<Component>& components, double min_size, double reach) {
    double least = std::numeric_limits<double>::infinity();
    for (const Component& component : components) least = std::min(least, component.box.diagonal());
    if (min_size <= least + 2 * reach) return Done{};
    return out_of_reach("min_size", number_text(min_size),
                        "at most " + number_text(least) + ", the diagonal of the source or of its smallest component");
}

Status check_max_valence(const std::vector<Component>& components, std::uint32_t max_valence) {
    constexpr std::uint32_t kMean = 6;
    if (max_valence > kMean) return Done{};
    for (const Component& component : components) {
        if (!component.closed || component.genus() < 2) continue;
        return out_of_reach("max_valence", std::to_string(max_valence),
                            "at least 7, since the source has a genus of " + std::to_string(component.genus()) +
                                ", with which the mean valence is over 6");
    }
    return Done{};
}

Status check_frozen(const TriangleMesh& mesh, const char* field, double max_size) {
    double longest = 0;
    for (const std::vector<HalfEdge>& loop : boundary_loops(mesh)) {
        for (const HalfEdge h : loop) {
            longest = std::max(longest, (mesh.positions[origin(mesh, h)] - mesh.positions[origin(mesh, next(h))]).norm());
        }
    }
    if (longest <= max_size) return Done{};
    return out_of_reach(field, number_text(max_size),
                        "at least " + number_text(longest) + ", the longest edge of the boundary that freeze_boundary keeps");
}

template <class Options>
Status check_sizes_of_frozen(const TriangleMesh& source, const Options& options) {
    if (!options.freeze_boundary.value_or(false) || !options.sizing || !options.sizing->max_size) return Done{};
    return check_frozen(source, "sizing.max_size", *options.sizing->max_size);
}

}  // namespace

Status check_reachable(const TriangleMesh& source, const ControlOptions& options) {
    if (options.min_size || options.max_valence) {
        const std::vector<Component> components = components_of(source);
        if (options.min_size) {
            const ControlOptions used = default_options(source, options);
            const double reach = used.max_deviation.value_or(*used.tolerance);
            if (Status s = check_min_size(components, *options.min_size, reach); !s) return s;
        }
        if (options.max_valence) {
            if (Status s = check_max_valence(components, *options.max_valence); !s) return s;
        }
    }
    if (options.max_size && options.freeze_boundary.value_or(false)) {
        if (Status s = check_frozen(source, "max_size", *options.max_size); !s) return s;
    }
    return check_sizes_of_frozen(source, options);
}

Status check_reachable(const TriangleMesh& source, const ImproveOptions& options) {
    return check_sizes_of_frozen(source, options);
}

}  // namespace vsplit

#include "vsplit/io/second_order.h"

#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>

#include "base/thread_limit.h"
#include "mesh/half_edges.h"
#include "spatial/surface_index.h"

namespace vsplit {
namespace {

constexpr double kLeastJacobian = 0.2;  // share of the flat triangle's
constexpr double kFarthest = 0.25;      // of a node from its chord's middle, in chords

using Corners = std::array<Vec3, 6>;  // three corners, then the middle of the side behind each

/// The derivatives' cross product along `normal`, at a point of a six-node triangle with barycentric coordinates `b`.
double jacobian(const Corners& x, const Vec3& normal, const std::array<double, 3>& b) {
    // N_i = b_i (2 b_i - 1), N_ij = 4 b_i b_j; derivatives with respect to b_1 and b_2, b_0 being the rest.
    const Vec3 by_0 = (4 * b[0] - 1) * x[0] + 4 * b[1] * x[3] + 4 * b[2] * x[5];
    const Vec3 by_1 = (4 * b[1] - 1) * x[1] + 4 * b[0] * x[3] + 4 * b[2] * x[4];
    const Vec3 by_2 = (4 * b[2] - 1) * x[2] + 4 * b[1] * x[4] + 4 * b[0] * x[5];
    return (by_1 - by_0).cross(by_2 - by_0).dot(normal);
}

/// Whether the Jacobian is nowhere too small: it is quadratic, and nowhere less than the least of its Bernstein coefficients.
bool is_sound(const Corners& x) {
    const Vec3 flat = (x[1] - x[0]).cross(x[2] - x[0]);
    const double least = kLeastJacobian * flat.squaredNorm();
    constexpr std::array<std::array<double, 3>, 3> kCorner{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    constexpr std::array<std::array<double, 3>, 3> kMiddle{{{.5, .5, 0}, {0, .5, .5}, {.5, 0, .5}}};
    std::array<double, 3> at{};
    for (std::size_t i = 0; i < 3; ++i) at[i] = jacobian(x, flat, kCorner[i]);
    for (std::size_t i = 0; i < 3; ++i) {
        const double between = 2 * jacobian(x, flat, kMiddle[i]) - (at[i] + at[(i + 1) % 3]) / 2;
        if (std::min(at[i], between) < least) return false;
    }
    return true;
}

class Builder {
public:
    explicit Builder(const TriangleMesh& mesh) : mesh_(mesh) {
        nodes_.of_face.resize(mesh.faces.size());
        EdgeIndex(mesh).for_each_edge([&](const EdgeIndex::Entry* first, const EdgeIndex::Entry* last) {
            const auto node = static_cast<std::uint32_t>(mesh.vertex_count() + chords_.size());
            chords_.push_back({first->a, first->b});
            for (const EdgeIndex::Entry* e = first; e != last; ++e)
                nodes_.of_face[face_of(e->half_edge)][e->half_edge % 3] = node;
        });
        curved_.assign(chords_.size(), 0);
        nodes_.positions.resize(chords_.size());
    }

    void place(const SurfaceIndex& surface) {
        tbb::parallel_for(std::size_t{0}, chords_.size(), [&](std::size_t edge) {
            const Vec3 middle = middle_of(edge);
            const double most = kFarthest * (mesh_.positions[chords_[edge][1]] - mesh_.positions[chords_[edge][0]]).norm();
            const SurfaceIndex::Hit hit = surface.closest(middle, most * most);
            curved_[edge] = hit.element == SurfaceIndex::kNoElement ? 0 : 1;
            nodes_.positions[edge] = curved_[edge] != 0 ? hit.point : middle;
        });
    }

    /// Straightens bad elements, and those that get bad by it; ends, as a node goes back once.
    MidsideNodes take_sound() {
        for (bool changed = true; changed;) {
            changed = false;
            for (std::size_t f = 0; f < mesh_.faces.size(); ++f) {
                if (!is_sound(corners(f)) && straighten(f)) changed = true;
            }
        }
        nodes_.on_chord = static_cast<std::uint32_t>(std::count(curved_.begin(), curved_.end(), 0));
        return std::move(nodes_);
    }

private:
    [[nodiscard]] Vec3 middle_of(std::size_t edge) const {
        return (mesh_.positions[chords_[edge][0]] + mesh_.positions[chords_[edge][1]]) / 2;
    }

    [[nodiscard]] Corners corners(std::size_t face) const {
        Corners x;
        for (std::size_t i = 0; i < 3; ++i) {
            x[i] = mesh_.positions[mesh_.faces[face][i]];
            x[i + 3] = nodes_.positions[nodes_.of_face[face][i] - mesh_.vertex_count()];
        }
        return x;
    }

    bool straighten(std::size_t face) {
        bool changed = false;
        for (const std::uint32_t node : nodes_.of_face[face]) {
            const std::size_t edge = node - mesh_.vertex_count();
            if (curved_[edge] == 0) continue;
            curved_[edge] = 0;
            nodes_.positions[edge] = middle_of(edge);
            changed = true;
        }
        return changed;
    }

    const TriangleMesh& mesh_;
    MidsideNodes nodes_;
    std::vector<std::array<std::uint32_t, 2>> chords_;
    std::vector<unsigned char> curved_;
};

}  // namespace

Expected<MidsideNodes> midside_nodes(const TriangleMesh& mesh, const TriangleMesh& source, const ExecutionContext& context) {
    if (source.faces.empty())
        return Error{Cause::kEmptyInput, "there is no surface to put mid-side nodes on: it has no faces", ""};
    Builder builder(mesh);
    with_thread_limit(context, [&] { builder.place(surface_index(source)); });
    if (context.cancelled()) return ExecutionContext::cancelled_error();
    return builder.take_sound();
}

}  // namespace vsplit

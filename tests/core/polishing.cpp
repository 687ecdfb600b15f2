#include "tests/core/polishing.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "method/prepare.h"
#include "tests/core/meshes.h"
#include "tests/core/random.h"
#include "vsplit/mesh/inspect.h"
#include "vsplit/quality/stretch.h"

namespace vsplit::test {

SimplifyInput simplify_input(const TriangleMesh& mesh, double tolerance_share) {
    SubdividedMesh same{mesh, std::vector<std::uint32_t>(mesh.faces.size())};
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) same.parent[f] = f;
    return prepare(mesh, std::move(same), {FeatureOptions{}, tolerance_share * bounding_box(mesh).diagonal(), 4, 4});
}

TriangleMesh jittered_cube(std::uint32_t cells, double share, std::uint64_t seed) {
    TriangleMesh mesh = noisy_cube(cells, 0, seed);
    Random random(seed);
    for (Vec3& p : mesh.positions) {
        for (double& x : p) {
            if (x != 0 && x != 1) x += random.uniform(-share, share) / cells;
        }
    }
    return mesh;
}

Polishing::Polishing(const TriangleMesh& source, double tolerance_share)
    : input(simplify_input(source, tolerance_share)), mesh(input.mesh, input.ghosts), state(initial_state(input)) {
    for (const SharpEdge& crease : input.creases) {
        mesh.for_each_outgoing(crease.a, [&](HalfEdge h) {
            if (mesh.target(h) == crease.b) mesh.mark_crease(h);
        });
    }
}

TriangleMesh Polishing::now() const {
    TriangleMesh result;
    for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) result.positions.push_back(mesh.position(v));
    for (HalfEdge h = 0; h < mesh.half_edge_count(); h += 3) {
        if (!mesh.removed(h)) result.faces.push_back({mesh.origin(h), mesh.origin(h + 1), mesh.origin(h + 2)});
    }
    return result;
}

std::vector<HalfEdge> Polishing::edges() const {
    std::vector<HalfEdge> all;
    for (HalfEdge h = 0; h < mesh.half_edge_count(); ++h) {
        if (!mesh.removed(h) && mesh.edge_of(h) == h) all.push_back(h);
    }
    return all;
}

bool Polishing::joined(std::uint32_t u, std::uint32_t v) const {
    bool found = false;
    mesh.for_each_outgoing(u, [&](HalfEdge h) { found = found || mesh.target(h) == v; });
    return found;
}

FaceState Polishing::measured(std::uint32_t face) const {
    const Vec3& a = mesh.position(mesh.origin(3 * face));
    const Vec3& b = mesh.position(mesh.origin(3 * face + 1));
    const Vec3& c = mesh.position(mesh.origin(3 * face + 2));
    return {(b - a).cross(c - a).normalized().cast<float>(), stretch(a, b, c), face_size(a, b, c)};
}

void expect_consistent(const Polishing& p) {
    for (std::uint32_t f = 0; f < p.state.faces.size(); ++f) {
        if (p.mesh.removed(3 * f)) continue;
        const FaceState wanted = p.measured(f);
        EXPECT_NEAR(p.state.faces[f].stretch, wanted.stretch, 1e-12) << "face " << f;
        EXPECT_NEAR(p.state.faces[f].size, wanted.size, 1e-12 * wanted.size) << "face " << f;
        EXPECT_LT((p.state.faces[f].normal - wanted.normal).norm(), 1e-5) << "face " << f;
    }
    EXPECT_TRUE(inspect(p.now()).closed);
    for (const HalfEdge h : p.edges()) {
        std::uint32_t same = 0;
        p.mesh.for_each_outgoing(p.mesh.origin(h), [&](HalfEdge g) { same += p.mesh.target(g) == p.mesh.target(h) ? 1 : 0; });
        EXPECT_EQ(same, 1U) << "edge " << h;
        EXPECT_GE(p.mesh.valence(p.mesh.origin(h)), 3U);
        EXPECT_GE(p.mesh.valence(p.mesh.target(h)), 3U);
    }
}

}  // namespace vsplit::test

#include "method/editable_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <utility>

#include "tests/core/meshes.h"
#include "tests/core/random.h"
#include "vsplit/mesh/inspect.h"

namespace vsplit::test {
namespace {

/// All that the class says of the mesh, found anew from its faces.
void expect_consistent(const EditableMesh& edited) {
    const TriangleMesh& mesh = edited.mesh();
    EXPECT_TRUE(inspect(mesh).closed);
    const std::vector<HalfEdge> twins = half_edge_twins(mesh);
    std::vector<std::uint32_t> valence(mesh.positions.size(), 0);
    for (HalfEdge h = 0; h < twins.size(); ++h) {
        ASSERT_EQ(edited.twin(h), twins[h]) << h;
        EXPECT_EQ(edited.is_crease(h), edited.is_crease(twins[h]));
        ++valence[edited.origin(h)];
    }
    for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
        EXPECT_EQ(edited.valence(v), valence[v]);
        const std::vector<HalfEdge> spokes = edited.spokes(v);
        EXPECT_EQ(spokes.size(), valence[v]);
        for (const HalfEdge h : spokes) EXPECT_EQ(edited.origin(h), v);
    }
}

/// Length of creases by weight.
std::map<double, double> crease_length(const TriangleMesh& mesh, const std::vector<SharpEdge>& creases) {
    std::map<double, double> length;
    for (const SharpEdge& edge : creases) length[edge.weight] += (mesh.positions[edge.a] - mesh.positions[edge.b]).norm();
    return length;
}

TEST(EditableMeshTest, SplitsAndTurnsKeepAClosedMeshAndItsCreases) {
    Random random(5);
    for (const TriangleMesh& source : {cube(), torus(7, 5), icosphere(1)}) {
        std::vector<SharpEdge> creases;
        for (HalfEdge h = 0; h < source.faces.size() * 3; h += 5) {
            const SharpEdge edge{origin(source, h), origin(source, next(h)), 1.0 + (h % 3)};
            const bool known = std::any_of(creases.begin(), creases.end(), [&](const SharpEdge& other) {
                return std::minmax(other.a, other.b) == std::minmax(edge.a, edge.b);
            });
            if (!known) creases.push_back(edge);
        }
        const auto before = crease_length(source, creases);
        EditableMesh mesh(source, creases);
        expect_consistent(mesh);
        int turned = 0;
        for (int n = 0; n < 60; ++n) {
            const HalfEdge h = random.below(3 * mesh.mesh().face_count());
            const std::uint32_t a = mesh.origin(h), b = mesh.target(h), c = mesh.origin(prev(h)),
                                d = mesh.origin(prev(mesh.twin(h)));
            if (n % 3 == 0) {
                const std::uint32_t m = mesh.split(h, (mesh.position(a) + mesh.position(b)) / 2);
                EXPECT_EQ(mesh.origin(h), a);
                EXPECT_EQ(mesh.target(h), m);
                EXPECT_TRUE(mesh.has_edge(m, b) && mesh.has_edge(m, c) && mesh.has_edge(m, d));
                EXPECT_FALSE(mesh.has_edge(a, b));
            } else if (!mesh.is_crease(h) && mesh.valence(a) > 3 && mesh.valence(b) > 3 && !mesh.has_edge(c, d)) {
                mesh.turn(h);
                EXPECT_TRUE(mesh.has_edge(c, d));
                EXPECT_FALSE(mesh.is_crease(h));
                ++turned;
            }
        }
        EXPECT_GT(turned, 5);
        expect_consistent(mesh);
        const auto after = crease_length(mesh.mesh(), mesh.creases());
        ASSERT_EQ(after.size(), before.size());
        for (const auto& [weight, length] : before) EXPECT_NEAR(after.at(weight), length, 1e-12 * length);
    }
}

TEST(EditableMeshTest, ASplitLeavesTheNumbersOfOtherSpokes) {
    EditableMesh mesh(icosphere(1), {});
    const std::vector<HalfEdge> before = mesh.spokes(0);
    mesh.split(before[1], mesh.position(0) * 0.5 + mesh.position(mesh.target(before[1])) * 0.5);
    std::vector<HalfEdge> after = mesh.spokes(0);
    std::rotate(after.begin(), std::find(after.begin(), after.end(), before[0]), after.end());
    EXPECT_EQ(after, before);
}

}  // namespace
}  // namespace vsplit::test

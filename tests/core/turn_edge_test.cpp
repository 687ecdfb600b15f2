#include "mesh/turn_edge.h"

#include <gtest/gtest.h>

#include "tests/core/edited_mrr.h"
#include "tests/core/meshes.h"
#include "tests/core/random.h"
#include "vsplit/mesh/inspect.h"

namespace vsplit::test {
namespace {

struct Arrays {
    TriangleMesh mesh;
    std::vector<HalfEdge> twin;

    explicit Arrays(const TriangleMesh& given) : mesh(given), twin(half_edge_twins(given)) {}
    friend bool operator==(const Arrays&, const Arrays&) = default;
};

/// Half-edges that may be turned in `mesh`.
std::vector<HalfEdge> turnable(const TriangleMesh& mesh) {
    const RandomEditor editor(mesh, 0, 0);
    std::vector<HalfEdge> all;
    for (HalfEdge h = 0; h < mesh.faces.size() * 3; ++h) {
        if (editor.may_flip(h)) all.push_back(h);
    }
    return all;
}

TEST(TurnEdgeTest, CornersAreThoseOfTheDefinition) {
    const Arrays before(icosphere(1));
    for (const HalfEdge h : turnable(before.mesh)) {
        Arrays after = before;
        turn_counter_clockwise(after.mesh, after.twin, h);
        const HalfEdge g = before.twin[h];
        const std::uint32_t a = origin(before.mesh, h), b = origin(before.mesh, g);
        const std::uint32_t c = origin(before.mesh, prev(h)), d = origin(before.mesh, prev(g));
        EXPECT_EQ(origin(after.mesh, h), d);
        EXPECT_EQ(origin(after.mesh, next(h)), c);
        EXPECT_EQ(origin(after.mesh, prev(h)), a);
        EXPECT_EQ(origin(after.mesh, g), c);
        EXPECT_EQ(origin(after.mesh, next(g)), d);
        EXPECT_EQ(origin(after.mesh, prev(g)), b);
        EXPECT_EQ(after.twin, half_edge_twins(after.mesh));
        EXPECT_TRUE(inspect(after.mesh).closed);
    }
}

TEST(TurnEdgeTest, EachWayUndoesTheOther) {
    const Arrays before(bumpy_sphere(1, 0.05, 3));
    const std::vector<HalfEdge> all = turnable(before.mesh);
    EXPECT_GT(all.size(), 100U);
    for (const HalfEdge h : all) {
        Arrays turned = before;
        turn_counter_clockwise(turned.mesh, turned.twin, h);
        ASSERT_NE(turned, before);
        turn_clockwise(turned.mesh, turned.twin, h);
        ASSERT_EQ(turned, before) << h;
        turn_clockwise(turned.mesh, turned.twin, h);
        EXPECT_EQ(turned.twin, half_edge_twins(turned.mesh));
        turn_counter_clockwise(turned.mesh, turned.twin, h);
        ASSERT_EQ(turned, before) << h;
    }
}

TEST(TurnEdgeTest, EitherHalfEdgeSaysTheSame) {
    const Arrays before(torus(8, 5));
    for (const HalfEdge h : turnable(before.mesh)) {
        for (const auto turn : {turn_counter_clockwise, turn_clockwise}) {
            Arrays one = before, other = before;
            turn(one.mesh, one.twin, h);
            turn(other.mesh, other.twin, before.twin[h]);
            ASSERT_EQ(one, other) << h;
        }
    }
}

TEST(TurnEdgeTest, TheSimplifiersMeshTurnsAlike) {
    Arrays arrays(icosphere(2));
    RandomEditor editor(arrays.mesh, 0, 0);
    Random random(4);
    int turned = 0;
    for (int n = 0; n < 2000; ++n) {
        const HalfEdge h = random.below(static_cast<std::uint32_t>(arrays.twin.size()));
        if (!editor.may_flip(h)) continue;
        ++turned;
        editor.mesh().flip(h);
        turn_counter_clockwise(arrays.mesh, arrays.twin, h);
        for (HalfEdge at = 0; at < arrays.twin.size(); ++at) {
            ASSERT_EQ(editor.mesh().origin(at), origin(arrays.mesh, at));
            ASSERT_EQ(editor.mesh().twin(at), arrays.twin[at]);
        }
        std::vector<std::uint32_t> valence(arrays.mesh.positions.size(), 0);
        for (HalfEdge at = 0; at < arrays.twin.size(); ++at) ++valence[origin(arrays.mesh, at)];
        for (std::uint32_t v = 0; v < valence.size(); ++v) {
            ASSERT_EQ(editor.mesh().valence(v), valence[v]);
            ASSERT_EQ(editor.mesh().origin(editor.mesh().outgoing(v)), v);
        }
    }
    EXPECT_GT(turned, 500);
}

}  // namespace
}  // namespace vsplit::test

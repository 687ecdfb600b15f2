#include "simplify/mesh_parts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <vector>

#include "mesh/cap_boundaries.h"
#include "tests/core/meshes.h"

namespace vsplit::test {
namespace {

using Depth = MeshParts::Depth;

/// Depths by their definitions, from lists of faces and neighbours.
std::vector<Depth> depths_of(const TriangleMesh& mesh, std::uint32_t ghosts, const MeshParts& parts) {
    std::vector<std::set<std::size_t>> parts_at(mesh.positions.size());
    std::vector<std::set<std::uint32_t>> neighbours(mesh.positions.size());
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
        std::size_t part = 0;
        while (f >= parts.faces(part).end) ++part;
        for (const std::uint32_t v : mesh.faces[f]) {
            parts_at[v].insert(part);
            neighbours[v].insert(mesh.faces[f].begin(), mesh.faces[f].end());
        }
    }
    std::vector<Depth> depths(mesh.positions.size(), Depth::kShared);
    for (std::uint32_t v = ghosts; v < mesh.vertex_count(); ++v) {
        if (parts_at[v].size() == 1) depths[v] = Depth::kOwned;
    }
    for (const Depth to : {Depth::kInterior, Depth::kDeep}) {
        const std::vector<Depth> before = depths;
        const auto less = static_cast<Depth>(static_cast<int>(to) - 1);
        for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
            const bool inside = std::all_of(neighbours[v].begin(), neighbours[v].end(),
                                            [&](std::uint32_t other) { return before[other] >= less; });
            if (inside) depths[v] = to;
        }
    }
    return depths;
}

void expect_parts(const TriangleMesh& mesh, std::uint32_t ghosts, bool shifted) {
    const HalfEdgeMesh half_edges(mesh, ghosts);
    const MeshParts parts(half_edges, shifted);
    ASSERT_GT(parts.count(), 2U);
    std::uint32_t next = 0;
    for (std::size_t part = 0; part < parts.count(); ++part) {
        EXPECT_EQ(parts.faces(part).begin, next);
        EXPECT_EQ(next % 4, 0U);
        next = parts.faces(part).end;
    }
    EXPECT_EQ(next, mesh.face_count());
    const std::vector<Depth> depths = depths_of(mesh, ghosts, parts);
    std::vector<std::vector<std::uint32_t>> interior(parts.count());
    std::vector<std::uint32_t> between;
    std::uint32_t deep = 0;
    for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
        ASSERT_EQ(parts.depth(v), depths[v]) << v;
        deep += depths[v] == Depth::kDeep ? 1 : 0;
        if (depths[v] < Depth::kInterior) {
            between.push_back(v);
            continue;
        }
        std::size_t part = 0;
        while (face_of(half_edges.outgoing(v)) >= parts.faces(part).end) ++part;
        interior[part].push_back(v);
    }
    for (std::size_t part = 0; part < parts.count(); ++part) {
        EXPECT_TRUE(
            std::equal(parts.interior(part).begin(), parts.interior(part).end(), interior[part].begin(), interior[part].end()));
    }
    EXPECT_EQ(parts.between(), between);
    EXPECT_DOUBLE_EQ(parts.deep_share(), static_cast<double>(deep) / mesh.vertex_count());
    EXPECT_GT(deep, 0U);
}

TEST(MeshPartsTest, DepthsAreAsDefined) {
    const CappedMesh open = *cap_boundaries(punctured(torus(250, 100), {0, 20000, 40000}));
    for (const bool shifted : {false, true}) {
        expect_parts(torus(250, 100), 0, shifted);
        expect_parts(open.mesh, open.ghosts, shifted);
    }
}

TEST(MeshPartsTest, ShiftedCutsAreElsewhere) {
    const HalfEdgeMesh mesh(torus(250, 100));
    const MeshParts plain(mesh, false), shifted(mesh, true);
    for (std::size_t part = 1; part < plain.count(); ++part) {
        for (std::size_t other = 1; other < shifted.count(); ++other)
            EXPECT_NE(plain.faces(part).begin, shifted.faces(other).begin);
    }
}

TEST(MeshPartsTest, AQuadMayTurnWhereItsFourVerticesAreInterior) {
    const TriangleMesh torus_mesh = torus(250, 100);
    const HalfEdgeMesh mesh(torus_mesh);
    const MeshParts parts(mesh, false);
    std::size_t inside = 0;
    for (HalfEdge h = 0; h < mesh.half_edge_count(); ++h) {
        std::set<std::uint32_t> quad(torus_mesh.faces[face_of(h)].begin(), torus_mesh.faces[face_of(h)].end());
        quad.insert(torus_mesh.faces[face_of(mesh.twin(h))].begin(), torus_mesh.faces[face_of(mesh.twin(h))].end());
        const bool all = std::all_of(quad.begin(), quad.end(), [&](std::uint32_t v) { return parts.is_interior(v); });
        ASSERT_EQ(parts.may_turn(mesh, h), all);
        inside += all ? 1 : 0;
    }
    EXPECT_GT(inside, 0U);
}

TEST(MeshPartsTest, ASmallMeshIsOnePart) {
    const MeshParts parts(HalfEdgeMesh(icosphere(3)), true);
    EXPECT_EQ(parts.count(), 1U);
    EXPECT_EQ(parts.faces(0).end, icosphere(3).face_count());
}

}  // namespace
}  // namespace vsplit::test

#include "wire/base_mesh.h"

#include <gtest/gtest.h>

#include "tests/core/meshes.h"

namespace vsplit::wire {
namespace {

Status add_all(const TriangleMesh& mesh, BaseMeshAssembler& assembler) {
    for (std::size_t part = 0; part < base_mesh_parts(mesh); ++part) {
        if (Status added = assembler.add(base_mesh_part(mesh, part)); !added) return added;
    }
    return Done{};
}

TEST(BaseMeshTest, SurvivesTheWay) {
    for (const TriangleMesh& mesh : {test::tetrahedron(), test::icosphere(6), TriangleMesh()}) {
        BaseMeshAssembler assembler;
        const Status added = add_all(mesh, assembler);
        ASSERT_TRUE(added);
        ASSERT_TRUE(assembler.complete());
        EXPECT_EQ(assembler.take(), mesh);
    }
}

TEST(BaseMeshTest, PartsAreSmallAndInOrder) {
    const TriangleMesh mesh = test::icosphere(6);
    ASSERT_GT(base_mesh_parts(mesh), 6U);
    bool faces_began = false;
    for (std::size_t part = 0; part < base_mesh_parts(mesh); ++part) {
        const v1::BaseMesh message = base_mesh_part(mesh, part);
        EXPECT_LE(message.positions().size() + message.indices().size(), kMaxPartBytes);
        EXPECT_GT(message.positions().size() + message.indices().size(), 0U);
        faces_began = faces_began || !message.indices().empty();
        EXPECT_TRUE(message.positions().empty() || !faces_began);
    }
}

TEST(BaseMeshTest, IsCompleteOnlyAfterTheLastPart) {
    const TriangleMesh mesh = test::tetrahedron();
    BaseMeshAssembler assembler;
    EXPECT_FALSE(assembler.complete());
    ASSERT_TRUE(assembler.add(base_mesh_part(mesh, 0)));
    EXPECT_FALSE(assembler.complete());
    ASSERT_TRUE(assembler.add(base_mesh_part(mesh, 1)));
    EXPECT_TRUE(assembler.complete());
    EXPECT_EQ(assembler.take(), mesh);
    EXPECT_EQ(assembler.add(base_mesh_part(mesh, 1)).error().cause, Cause::kOutOfOrder);
}

TEST(BaseMeshTest, RefusesPartsOutOfOrder) {
    const TriangleMesh mesh = test::icosphere(6);
    BaseMeshAssembler skipping;
    ASSERT_TRUE(skipping.add(base_mesh_part(mesh, 0)));
    EXPECT_EQ(skipping.add(base_mesh_part(mesh, 2)).error().cause, Cause::kOutOfOrder);
    BaseMeshAssembler repeating;
    ASSERT_TRUE(repeating.add(base_mesh_part(mesh, 0)));
    EXPECT_EQ(repeating.add(base_mesh_part(mesh, 0)).error().cause, Cause::kOutOfOrder);
    BaseMeshAssembler faces_first;
    EXPECT_EQ(faces_first.add(base_mesh_part(mesh, base_mesh_parts(mesh) - 1)).error().cause, Cause::kOutOfOrder);
    v1::BaseMesh early_faces;
    early_faces.set_vertices(4);
    early_faces.set_faces(4);
    early_faces.set_indices(std::string(12, '\0'));
    BaseMeshAssembler early;
    EXPECT_EQ(early.add(early_faces).error().cause, Cause::kOutOfOrder);
}

TEST(BaseMeshTest, RefusesBytesThatDoNotFit) {
    v1::BaseMesh part = base_mesh_part(test::tetrahedron(), 0);
    part.mutable_positions()->pop_back();
    EXPECT_EQ(BaseMeshAssembler().add(part).error().cause, Cause::kCorrupt);
    part = base_mesh_part(test::tetrahedron(), 0);
    part.mutable_positions()->append(24, '\0');
    EXPECT_EQ(BaseMeshAssembler().add(part).error().cause, Cause::kCorrupt);
}

TEST(BaseMeshTest, RefusesPartsThatDisagreeOnTheWhole) {
    BaseMeshAssembler assembler;
    ASSERT_TRUE(assembler.add(base_mesh_part(test::tetrahedron(), 0)));
    v1::BaseMesh other = base_mesh_part(test::tetrahedron(), 1);
    other.set_faces(5);
    EXPECT_EQ(assembler.add(other).error().cause, Cause::kCorrupt);
    BaseMeshAssembler with_ghosts;
    ASSERT_TRUE(with_ghosts.add(base_mesh_part(test::tetrahedron(), 0, 1)));
    EXPECT_EQ(with_ghosts.ghosts(), 1U);
    EXPECT_EQ(with_ghosts.add(base_mesh_part(test::tetrahedron(), 1)).error().cause, Cause::kCorrupt);
}

TEST(BaseMeshTest, RefusesAStreamOfNothing) {
    v1::BaseMesh empty;
    empty.set_vertices(4);
    empty.set_faces(4);
    EXPECT_EQ(BaseMeshAssembler().add(empty).error().cause, Cause::kCorrupt);
}

TEST(BaseMeshTest, TakesNoMemoryOnTheWordOfAHeader) {
    v1::BaseMesh lying = base_mesh_part(test::tetrahedron(), 0);
    lying.set_vertices(4'000'000'000U);
    lying.set_faces(4'000'000'000U);
    EXPECT_EQ(BaseMeshAssembler().add(lying).error().cause, Cause::kLimitExceeded);
    lying.set_vertices(50'000'000U);
    lying.set_faces(50'000'000U);
    BaseMeshAssembler assembler;
    EXPECT_TRUE(assembler.add(lying));  // four vertices have come, room for four is taken
    EXPECT_FALSE(assembler.complete());
}

}  // namespace
}  // namespace vsplit::wire

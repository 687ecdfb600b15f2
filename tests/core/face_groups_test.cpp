#include "vsplit/mesh/face_groups.h"

#include <gtest/gtest.h>

#include "tests/core/meshes.h"
#include "vsplit/mesh/inspect.h"

namespace vsplit {
namespace {

/// A cube whose faces have the regions 5, 5, 5, 7, 7, 9, then 9.
TriangleMesh cube_in_regions() {
    TriangleMesh mesh = test::cube();
    mesh.regions.assign(mesh.face_count(), 9);
    for (std::size_t f = 0; f < 5; ++f) mesh.regions[f] = f < 3 ? 5 : 7;
    return mesh;
}

TEST(FaceGroupsTest, SetsComeFirstThenRegionsInNoSet) {
    TriangleMesh mesh = cube_in_regions();
    mesh.sets = {{"top", {7, 5, 7}}, {"bottom", {5}}, {"nothing", {1}}};
    const FaceGroups groups = list_groups(mesh);
    EXPECT_EQ(groups.count, 4U);
    const std::vector<FaceGroup> expected{{"top", {5, 7}, 5}, {"bottom", {5}, 3}, {"nothing", {1}, 0}, {"", {9}, 7}};
    EXPECT_EQ(groups.listed, expected);
    EXPECT_EQ(inspect(mesh).groups, groups);
    EXPECT_EQ(list_groups(test::cube()), FaceGroups());
}

TEST(FaceGroupsTest, AsManyAreListedAsAPageHolds) {
    TriangleMesh mesh = test::icosphere(2);
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) mesh.regions.push_back(f);
    mesh.sets = {{"all", mesh.regions}, {"none", {}}};
    FaceGroups groups = list_groups(mesh);
    EXPECT_EQ(groups.count, 2U);
    EXPECT_EQ(groups.listed[0].regions.size(), FaceGroup::kRegions);
    EXPECT_EQ(groups.listed[0].faces, mesh.face_count());
    mesh.sets.clear();
    groups = list_groups(mesh);
    EXPECT_EQ(groups.count, mesh.face_count());
    EXPECT_EQ(groups.listed.size(), FaceGroups::kListed);
    EXPECT_EQ(groups.listed[99], (FaceGroup{"", {99}, 1}));
}

}  // namespace
}  // namespace vsplit

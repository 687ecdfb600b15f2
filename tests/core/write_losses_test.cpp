#include "vsplit/io/write_losses.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "tests/core/meshes.h"
#include "vsplit/io/read_mesh.h"
#include "vsplit/io/write_mesh.h"

namespace vsplit {
namespace {

/// Two regions: a set of both, one of the second, and another of the second.
TriangleMesh grouped_frame() {
    TriangleMesh mesh = test::cube_frame();
    mesh.regions.assign(mesh.faces.size(), 1);
    std::fill(mesh.regions.begin(), mesh.regions.begin() + 8, 2);
    mesh.sets = {{"skin", {1, 2}}, {"rim", {2}}, {"edge", {2}}};
    return mesh;
}

TEST(WriteLossesTest, WhatIsLeftOutIsWhatAReaderDoesNotFind) {
    const TriangleMesh mesh = grouped_frame();
    for (const MeshFormat format : mesh_formats()) {
        SCOPED_TRACE(format_name(format));
        const std::string written = write_mesh(mesh, format, LengthUnit::kMillimetre);
        const auto read = read_mesh(std::as_bytes(std::span(written)), {.format = format});
        ASSERT_TRUE(read) << read.error().message;
        std::set<std::string> found;
        for (const FaceSet& set : read->mesh.sets) found.insert(set.name);
        std::vector<std::string> missing;
        for (const FaceSet& set : mesh.sets) {
            if (found.count(set.name) == 0) missing.push_back(set.name);
        }
        EXPECT_EQ(sets_left_out(mesh, format), missing);
    }
}

TEST(WriteLossesTest, SinglePrecisionIsCoarseFarFromTheOrigin) {
    TriangleMesh mesh = grouped_frame();
    EXPECT_FALSE(rounding_of(mesh, MeshFormat::kStlBinary).is_coarse());
    for (Vec3& position : mesh.positions) position.x() += 1e8;
    EXPECT_TRUE(rounding_of(mesh, MeshFormat::kStlBinary).is_coarse());
    EXPECT_TRUE(rounding_of(mesh, MeshFormat::kStlAscii).is_coarse());
    EXPECT_FALSE(rounding_of(mesh, MeshFormat::kObj).is_coarse());
}

}  // namespace
}  // namespace vsplit

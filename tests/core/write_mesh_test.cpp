#include "vsplit/io/write_mesh.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <fstream>
#include <sstream>
#include <string>

#include "tests/core/meshes.h"
#include "vsplit/io/read_mesh.h"

namespace vsplit::test {
namespace {

namespace fs = std::filesystem;

const std::span<const MeshFormat> kFormats = mesh_formats();
constexpr std::array kExactFormats = {MeshFormat::kObj, MeshFormat::kPlyBinary, MeshFormat::kPlyAscii, MeshFormat::kOff,
                                      MeshFormat::kMsh, MeshFormat::kMshAscii,  MeshFormat::kMsh2,     MeshFormat::kMsh2Ascii,
                                      MeshFormat::kVtk, MeshFormat::kVtkAscii,  MeshFormat::kVtu,      MeshFormat::k3mf};

TriangleMesh read(const std::string& bytes) {
    const Expected<ReadResult> result = read_mesh(std::as_bytes(std::span(bytes)), {});
    EXPECT_TRUE(result) << result.error().message;
    return result ? result->mesh : TriangleMesh();
}

/// A directory of this process, gone with this object.
class TemporaryDirectory {
public:
    TemporaryDirectory() : path_(fs::temp_directory_path() / ("vsplit_write_test_" + std::to_string(::getpid()))) {
        fs::create_directory(path_);
    }
    TemporaryDirectory(const TemporaryDirectory&) = delete;
    TemporaryDirectory& operator=(const TemporaryDirectory&) = delete;
    ~TemporaryDirectory() {
        std::error_code ignored;
        fs::remove_all(path_, ignored);
    }
    [[nodiscard]] const fs::path& path() const { return path_; }

private:
    fs::path path_;
};

std::string content(const fs::path& path) {
    std::ostringstream text;
    text << std::ifstream(path, std::ios::binary).rdbuf();
    return text.str();
}

TEST(WriteMeshTest, DoublesReadBackExactly) {
    std::vector<NamedMesh> meshes = small_meshes();
    meshes.push_back({"awkward numbers",
                      {{{0.1, 1e-300, 1e15}, {-1.0 / 3, 5e-324, -1e15}, {std::nextafter(1.0, 2.0), -0.0, 123456789.123456789}},
                       {{0, 1, 2}, {2, 1, 0}}}});
    for (const auto& [name, mesh] : meshes) {
        for (const MeshFormat format : kExactFormats) {
            EXPECT_EQ(read(write_mesh(mesh, format)), mesh) << name << " as " << format_name(format);
        }
    }
}

TEST(WriteMeshTest, StlHoldsSinglePrecision) {
    for (const auto& [name, mesh] : small_meshes()) {
        const TriangleMesh binary = read(write_mesh(mesh, MeshFormat::kStlBinary));
        const TriangleMesh ascii = read(write_mesh(mesh, MeshFormat::kStlAscii));
        ASSERT_EQ(binary.face_count(), mesh.face_count()) << name;
        ASSERT_EQ(ascii.face_count(), mesh.face_count()) << name;
        for (std::uint32_t face = 0; face < mesh.face_count(); ++face) {
            for (std::size_t corner = 0; corner < 3; ++corner) {
                const Eigen::Vector3f expected = mesh.positions[mesh.faces[face][corner]].cast<float>();
                EXPECT_EQ(binary.positions[binary.faces[face][corner]].cast<float>(), expected) << name;
                EXPECT_EQ(ascii.positions[ascii.faces[face][corner]].cast<float>(), expected) << name;
            }
        }
    }
}

TEST(WriteMeshTest, SameMeshGivesSameBytes) {
    for (const MeshFormat format : kFormats) EXPECT_EQ(write_mesh(torus(24, 12), format), write_mesh(torus(24, 12), format));
}

TEST(WriteMeshTest, StlAsciiToTheLetter) {
    const TriangleMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 0.1, 0}}, {{0, 1, 2}}};
    EXPECT_EQ(write_mesh(mesh, MeshFormat::kStlAscii),
              "solid vsplit\n  facet normal 0 0 1\n    outer loop\n      vertex 0 0 0\n      vertex 1 0 0\n"
              "      vertex 0 0.1 0\n    endloop\n  endfacet\nendsolid vsplit\n");
}

TEST(WriteMeshTest, ObjToTheLetter) {
    const TriangleMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 0.1, -2.5e-7}}, {{0, 1, 2}}};
    EXPECT_EQ(write_mesh(mesh, MeshFormat::kObj), "v 0 0 0\nv 1 0 0\nv 0 0.1 -2.5e-07\nf 1 2 3\n");
}

TEST(WriteMeshTest, FaceWithoutAreaHasNoNormal) {
    const TriangleMesh mesh{{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}}};
    EXPECT_NE(write_mesh(mesh, MeshFormat::kStlAscii).find("facet normal 0 0 0\n"), std::string::npos);
}

TEST(WriteMeshTest, EmptyMeshIsAFileWithoutFaces) {
    for (const MeshFormat format : kFormats) {
        const std::string bytes = write_mesh(TriangleMesh(), format);
        const Expected<ReadResult> result = read_mesh(std::as_bytes(std::span(bytes)), {.format = format});
        ASSERT_FALSE(result) << format_name(format);
        EXPECT_EQ(result.error().cause, Cause::kEmptyInput) << format_name(format);
    }
}

TEST(WriteMeshTest, FileHoldsTheBytesAndNothingIsLeftBeside) {
    const TemporaryDirectory directory;
    const fs::path path = directory.path() / "cube.obj";
    for (const TriangleMesh& mesh : {cube(), tetrahedron()}) {  // new, then over the old one
        ASSERT_TRUE(write_mesh_file(mesh, MeshFormat::kObj, path));
        EXPECT_EQ(content(path), write_mesh(mesh, MeshFormat::kObj));
    }
    EXPECT_EQ(std::distance(fs::directory_iterator(directory.path()), fs::directory_iterator()), 1);
}

TEST(WriteMeshTest, LinkIsFollowed) {
    const TemporaryDirectory directory;
    const fs::path target = directory.path() / "target.off";
    const fs::path link = directory.path() / "link.off";
    ASSERT_TRUE(write_mesh_file(cube(), MeshFormat::kOff, target));
    fs::create_symlink(target, link);
    ASSERT_TRUE(write_mesh_file(tetrahedron(), MeshFormat::kOff, link));
    EXPECT_TRUE(fs::is_symlink(link));
    EXPECT_EQ(content(target), write_mesh(tetrahedron(), MeshFormat::kOff));
}

TEST(WriteMeshTest, DeviceIsWrittenToAndNotReplaced) {
    ASSERT_TRUE(write_mesh_file(cube(), MeshFormat::kOff, "/dev/null"));
    EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

TEST(WriteMeshTest, RefusalNamesThePath) {
    const TemporaryDirectory directory;
    const Status nowhere = write_mesh_file(cube(), MeshFormat::kOff, directory.path() / "no" / "such" / "directory.off");
    ASSERT_FALSE(nowhere);
    EXPECT_NE(nowhere.error().message.find("directory.off"), std::string::npos) << nowhere.error().message;
    const Status over = write_mesh_file(cube(), MeshFormat::kOff, directory.path());
    ASSERT_FALSE(over);
    EXPECT_EQ(over.error().cause, Cause::kFileAccess);
    EXPECT_NE(over.error().message.find(directory.path().string()), std::string::npos) << over.error().message;
}

}  // namespace
}  // namespace vsplit::test

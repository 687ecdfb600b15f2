#include "part_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "tests/temp_directory.h"

namespace vsplit::client {
namespace {

namespace fs = std::filesystem;

std::string content(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

std::ptrdiff_t files_in(const fs::path& directory) {
    return std::distance(fs::directory_iterator(directory), fs::directory_iterator());
}

TEST(PartFileTest, AppearsWholeAndOnlyOnCommit) {
    const test::TempDirectory directory;
    const fs::path path = directory.path() / "mesh.stl";
    Expected<PartFile> file = PartFile::create(path);
    ASSERT_TRUE(file);
    ASSERT_TRUE(file->write("abc"));
    ASSERT_TRUE(file->write("defg"));
    EXPECT_EQ(file->size(), 7U);
    EXPECT_FALSE(fs::exists(path));
    ASSERT_TRUE(file->commit());
    EXPECT_EQ(content(path), "abcdefg");
    EXPECT_EQ(files_in(directory.path()), 1);
}

TEST(PartFileTest, LeavesTheOldFileWhenItIsNotCommitted) {
    const test::TempDirectory directory;
    const fs::path path = directory.path() / "mesh.stl";
    std::ofstream(path) << "old";
    {
        Expected<PartFile> file = PartFile::create(path);
        ASSERT_TRUE(file);
        const PartFile moved = *std::move(file);
    }
    EXPECT_EQ(content(path), "old");
    EXPECT_EQ(files_in(directory.path()), 1);
}

TEST(PartFileTest, SaysWhyItCannotBeMade) {
    const test::TempDirectory directory;
    EXPECT_EQ(PartFile::create(directory.path() / "no" / "mesh.stl").error().cause, Cause::kNotFound);
}

}  // namespace
}  // namespace vsplit::client

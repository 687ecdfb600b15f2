#include "service/temp_file.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace vsplit::service {
namespace {

std::span<const std::byte> bytes_of(std::string_view text) { return std::as_bytes(std::span(text)); }

std::string text_of(const FileMapping& mapping) {
    std::string text;
    for (const std::byte byte : mapping.bytes()) text += static_cast<char>(byte);
    return text;
}

TEST(TempFileTest, HoldsWhatWasAppended) {
    Expected<TempFile> file = TempFile::create();
    ASSERT_TRUE(file) << file.error().message;
    ASSERT_TRUE(file->append(bytes_of("one ")));
    ASSERT_TRUE(file->append(bytes_of("")));
    ASSERT_TRUE(file->append(bytes_of("two")));
    EXPECT_EQ(file->size(), 7U);
    const Expected<FileMapping> mapping = file->map();
    ASSERT_TRUE(mapping);
    EXPECT_EQ(text_of(*mapping), "one two");
}

TEST(TempFileTest, AMappingOutlivesItsFile) {
    FileMapping kept;
    {
        Expected<TempFile> file = TempFile::create();
        ASSERT_TRUE(file && file->append(bytes_of("still here")));
        kept = *file->map();
    }
    EXPECT_EQ(text_of(kept), "still here");
}

TEST(TempFileTest, AnEmptyFileMapsToNoBytes) {
    const Expected<TempFile> file = TempFile::create();
    ASSERT_TRUE(file);
    const Expected<FileMapping> mapping = file->map();
    ASSERT_TRUE(mapping);
    EXPECT_TRUE(mapping->bytes().empty());
}

TEST(TempFileTest, LeavesNothingInItsDirectory) {
    const std::filesystem::path directory = std::filesystem::path(::testing::TempDir()) / "vsplit_temp_file_test";
    std::filesystem::create_directory(directory);
    setenv("TMPDIR", directory.c_str(), 1);
    {
        Expected<TempFile> file = TempFile::create();
        ASSERT_TRUE(file && file->append(bytes_of("bytes")));
        EXPECT_TRUE(std::filesystem::is_empty(directory)) << "it has no name even while it is open";
    }
    unsetenv("TMPDIR");
    EXPECT_TRUE(std::filesystem::is_empty(directory));
    std::filesystem::remove(directory);
}

TEST(TempFileTest, SaysWhenTheDirectoryRefusesIt) {
    setenv("TMPDIR", "/proc", 1);  // exists, and nobody can make a file in it
    const Expected<TempFile> file = TempFile::create();
    unsetenv("TMPDIR");
    ASSERT_FALSE(file);
    EXPECT_EQ(file.error().cause, Cause::kUnavailable);
}

}  // namespace
}  // namespace vsplit::service

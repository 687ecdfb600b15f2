#include "store/data_dir.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>
#include <string>

#include "store/sqlite.h"
#include "store/sqlite_session_index.h"
#include "tests/temp_directory.h"

namespace vsplit::store {
namespace {

using ::testing::HasSubstr;

class DataDirTest : public ::testing::Test {
protected:
    Expected<DataDir> open() {
        return DataDir::open(directory_, 0, [this](const std::string& message) { told_ += message + '\n'; });
    }

    test::TempDirectory scratch_;
    const std::filesystem::path directory_ = scratch_.path() / "data" / "vsplit";
    std::string told_;
};

TEST_F(DataDirTest, IsMadeForItsOwnerAlone) {
    ASSERT_TRUE(open());
    struct stat about {};
    ASSERT_EQ(stat(directory_.c_str(), &about), 0);
    EXPECT_EQ(about.st_mode & 0777U, 0700U);
    EXPECT_TRUE(std::filesystem::is_directory(directory_ / "uploads"));
    EXPECT_EQ(told_, "");
}

TEST_F(DataDirTest, BelongsToOneServerAtATime) {
    {
        const auto first = open();
        ASSERT_TRUE(first);
        const auto second = open();
        ASSERT_FALSE(second);
        EXPECT_EQ(second.error().cause, Cause::kInvalidOption);
        EXPECT_THAT(second.error().message, HasSubstr("another vsplitd"));
    }
    EXPECT_TRUE(open());
}

TEST_F(DataDirTest, AFileInItsPlaceIsRefused) {
    std::filesystem::create_directories(directory_.parent_path());
    std::ofstream(directory_) << "a file";
    const auto opened = open();
    ASSERT_FALSE(opened);
    EXPECT_THAT(opened.error().message, HasSubstr(directory_.string()));
}

TEST_F(DataDirTest, ADamagedIndexIsPutAsideAsItIs) {
    ASSERT_TRUE(open());
    std::filesystem::create_directories(directory_ / "blobs" / "ab");
    std::ofstream(directory_ / "blobs" / "ab" / "something") << "of a session";
    std::filesystem::remove(directory_ / "sessions.db-wal");
    std::filesystem::remove(directory_ / "sessions.db-shm");
    const std::string damage(5000, '?');
    std::ofstream(directory_ / "sessions.db") << damage;
    ASSERT_TRUE(open());
    EXPECT_THAT(told_, HasSubstr("damaged-1"));
    std::ifstream kept(directory_ / "damaged-1" / "sessions.db");
    EXPECT_EQ(std::string(std::istreambuf_iterator<char>(kept), {}), damage);
    EXPECT_TRUE(std::filesystem::exists(directory_ / "damaged-1" / "blobs" / "ab" / "something"));
    std::ofstream(directory_ / "sessions.db") << damage;
    ASSERT_TRUE(open());
    EXPECT_TRUE(std::filesystem::exists(directory_ / "damaged-2" / "sessions.db"));
}

TEST_F(DataDirTest, ALaterVersionIsLeftAlone) {
    ASSERT_TRUE(open());
    {
        auto database = Database::open(directory_ / "sessions.db");
        ASSERT_TRUE(database && database->run("PRAGMA user_version = 2"));
    }
    const auto opened = open();
    ASSERT_FALSE(opened);
    EXPECT_EQ(opened.error().cause, Cause::kUnsupported);
    EXPECT_THAT(opened.error().message, HasSubstr("has version 2"));
    EXPECT_EQ(told_, "");
    EXPECT_FALSE(std::filesystem::exists(directory_ / "damaged-1"));
}

TEST_F(DataDirTest, AnIndexThatLostARowOfItsPagesIsDamaged) {
    {
        ASSERT_TRUE(open());
        auto index = SqliteSessionIndex::open(directory_ / "sessions.db");
        ASSERT_TRUE(index);
        for (std::uint64_t number = 1; number <= 200; ++number) {
            ASSERT_TRUE((*index)->add_session({number, std::to_string(number), "", 0, 0, 0, {"", std::string(500, 'x')}}));
        }
    }
    {
        std::fstream file(directory_ / "sessions.db", std::ios::in | std::ios::out);
        file.seekp(8 * 4096);
        file << std::string(3 * 4096, '\xa5');
    }
    ASSERT_TRUE(open());
    EXPECT_THAT(told_, HasSubstr("put aside untouched"));
}

}  // namespace
}  // namespace vsplit::store

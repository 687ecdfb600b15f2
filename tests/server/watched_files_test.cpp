#include "guard/watched_files.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>
#include <string>

#include "tests/temp_directory.h"

namespace vsplit::guard {
namespace {

class WatchedFilesTest : public ::testing::Test {
protected:
    WatchedFilesTest() { std::ofstream(file_) << "one"; }

    test::TempDirectory scratch_;
    const std::string file_ = (scratch_.path() / "file").string();
};

TEST_F(WatchedFilesTest, NoticesWhatIsWrittenReplacedOrMadeReadable) {
    WatchedFiles watched({file_}, std::chrono::milliseconds(0));
    EXPECT_FALSE(watched.changed());
    std::ofstream(file_) << "longer";
    EXPECT_TRUE(watched.changed());
    EXPECT_FALSE(watched.changed());
    ASSERT_EQ(chmod(file_.c_str(), 0640), 0);
    EXPECT_TRUE(watched.changed()) << "it could not be read before, perhaps";
    EXPECT_FALSE(watched.changed());
}

TEST_F(WatchedFilesTest, WhatCouldNotBeUsedIsTriedAgainAndToldOnce) {
    WatchedFiles watched({file_}, std::chrono::milliseconds(0));
    const Status failed = Error{Cause::kFileAccess, "no", ""};
    EXPECT_TRUE(watched.note(failed));
    EXPECT_TRUE(watched.changed()) << "a directory may have let nobody in";
    EXPECT_FALSE(watched.note(failed));
    EXPECT_TRUE(watched.note(Error{Cause::kFileAccess, "another reason", ""}));
    EXPECT_TRUE(watched.changed());
    EXPECT_TRUE(watched.note(Done{}));
    EXPECT_FALSE(watched.changed());
}

}  // namespace
}  // namespace vsplit::guard

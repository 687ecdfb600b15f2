#include "store/data_dir.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <string>
#include <thread>

#include "store/sqlite.h"
#include "store/sqlite_session_index.h"
#include "tests/temp_directory.h"

namespace vsplit::store {
namespace {

using ::testing::HasSubstr;

class DataDirTest : public ::testing::Test {
protected:
    DataDirTest() : umask_(umask(077)) {}  // as the server has it
    ~DataDirTest() override { umask(umask_); }

    Expected<DataDir> open() {
        return DataDir::open(directory_, 0, [this](const std::string& message) { told_ += message + '\n'; });
    }

    mode_t umask_;
    test::TempDirectory scratch_;
    std::filesystem::path directory_ = scratch_.path() / "data" / "vsplit";
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

TEST_F(DataDirTest, APlaceThatCannotBeIsAnErrorNotAnEnd) {
    const auto refusal = [this](const std::filesystem::path& path) {
        const auto opened = DataDir::open(path, 0, [this](const std::string& message) { told_ += message; });
        return opened ? std::string("opened") : opened.error().message;
    };
    EXPECT_THAT(refusal(scratch_.path() / std::string(300, 'x')), HasSubstr("File name too long"));
    const auto loop = scratch_.path() / "loop";
    std::filesystem::create_symlink(loop, loop);
    EXPECT_THAT(refusal(loop), HasSubstr("Too many levels of symbolic links"));
    EXPECT_THAT(refusal(loop / "under"), HasSubstr("Too many levels of symbolic links"));
    EXPECT_EQ(told_, "");
}

TEST_F(DataDirTest, WhatIsOfAnotherKindIsNamed) {
    for (const char* name : {"sessions.db", "reserve", "blobs", "blobs/incoming", "uploads"}) {
        std::filesystem::remove_all(directory_);
        ASSERT_TRUE(open());
        const auto path = directory_ / name;
        const bool file = std::filesystem::is_regular_file(path);
        std::filesystem::remove_all(path);
        if (file) {
            std::filesystem::create_directory(path);
        } else {
            std::ofstream(path) << "a file";
        }
        const auto opened = open();
        ASSERT_FALSE(opened) << name;
        EXPECT_EQ(opened.error().message,
                  path.string() + " is not a " + (file ? "file" : "directory") + ", as vsplitd needs it; move it away");
    }
}

TEST_F(DataDirTest, AnIndexThatSomebodyLooksAtIsWaitedFor) {
    ASSERT_TRUE(open());
    auto other = *Database::open(directory_ / "sessions.db");
    ASSERT_TRUE(other.run("BEGIN IMMEDIATE"));
    std::thread looks([&other] {
        std::this_thread::sleep_for(std::chrono::milliseconds(200));
        EXPECT_TRUE(other.run("COMMIT"));
    });
    const auto index = SqliteSessionIndex::open(directory_ / "sessions.db");
    ASSERT_TRUE(index);
    EXPECT_TRUE((*index)->add_loose("blob"));
    looks.join();
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
    auto again = open();
    ASSERT_TRUE(again);
    EXPECT_TRUE(std::filesystem::exists(directory_ / "damaged-2" / "sessions.db"));
    EXPECT_EQ(again->take_archive()->use().set_aside, 2U) << "an alert fires for them";
}

/// An index whose server was killed: sessions in its log, none in itself.
void make_killed_index(const std::filesystem::path& directory, std::uint64_t sessions) {
    const auto live = directory / "live";
    std::filesystem::create_directories(live);
    const auto index = *SqliteSessionIndex::open(live / "sessions.db");
    for (std::uint64_t number = 1; number <= sessions; ++number) {
        ASSERT_TRUE(index->add_session({number, std::to_string(number), "", 0, 0, 0, {}}));
    }
    for (const char* name : {"sessions.db", "sessions.db-wal"}) std::filesystem::copy_file(live / name, directory / name);
}

TEST_F(DataDirTest, ALogWithoutItsIndexIsPutAside) {
    for (const bool empty : {false, true}) {
        told_.clear();
        std::filesystem::remove_all(directory_);
        make_killed_index(directory_, 3);
        const auto log = std::filesystem::file_size(directory_ / "sessions.db-wal");
        if (empty) {
            std::filesystem::resize_file(directory_ / "sessions.db", 0);
        } else {
            std::filesystem::remove(directory_ / "sessions.db");
        }
        ASSERT_TRUE(open());
        EXPECT_THAT(told_, HasSubstr("its log is not; put aside untouched in "));
        EXPECT_EQ(std::filesystem::file_size(directory_ / "damaged-1" / "sessions.db-wal"), log);
    }
}

TEST_F(DataDirTest, ALogThatIsDamagedInTheMiddleIsKept) {
    make_killed_index(directory_, 4);
    const auto path = directory_ / "sessions.db-wal";
    std::filesystem::create_directories(directory_ / "blobs" / "ab");
    std::ofstream(directory_ / "blobs" / "ab" / "something") << "of a session";
    const auto log = std::filesystem::file_size(path);
    std::fstream(path, std::ios::in | std::ios::out).seekp(static_cast<std::streamoff>(log / 2)).write("?!", 2);
    ASSERT_TRUE(open());
    EXPECT_THAT(told_, HasSubstr("the log of the data directory's index is damaged"));
    EXPECT_EQ(std::filesystem::file_size(directory_ / "damaged-1" / "sessions.db-wal"), log);
    EXPECT_TRUE(std::filesystem::exists(directory_ / "damaged-1" / "sessions.db"));
    EXPECT_TRUE(std::filesystem::exists(directory_ / "damaged-1" / "blobs" / "ab" / "something"));
    told_.clear();
    ASSERT_TRUE(open());
    EXPECT_EQ(told_, "") << "once";
}

TEST_F(DataDirTest, ALogThatIsDamagedInTheMiddleIsKeptOnceWhateverEndsTheServer) {
    make_killed_index(directory_, 4);
    const auto path = directory_ / "sessions.db-wal";
    const auto log = std::filesystem::file_size(path);
    std::fstream(path, std::ios::in | std::ios::out).seekp(static_cast<std::streamoff>(log / 2)).write("?!", 2);
    const auto killed = scratch_.path() / "killed";
    {
        const auto running = open();
        ASSERT_TRUE(running);
        std::filesystem::copy(directory_, killed, std::filesystem::copy_options::recursive);
    }
    told_.clear();
    directory_ = killed;
    ASSERT_TRUE(open());
    EXPECT_EQ(told_, "");
    EXPECT_FALSE(std::filesystem::exists(killed / "damaged-2"));
}

TEST_F(DataDirTest, ALogThatACrashCutShortIsNotReported) {
    make_killed_index(directory_, 4);
    const auto path = directory_ / "sessions.db-wal";
    std::filesystem::resize_file(path, std::filesystem::file_size(path) - 100);
    ASSERT_TRUE(open());
    EXPECT_EQ(told_, "");
}

TEST_F(DataDirTest, ADirectoryThatIsThereKeepsItsPermissions) {
    std::filesystem::create_directories(directory_);
    std::filesystem::permissions(directory_, std::filesystem::perms(0755));
    ASSERT_TRUE(open());
    struct stat about {};
    ASSERT_EQ(stat(directory_.c_str(), &about), 0);
    EXPECT_EQ(about.st_mode & 0777U, 0755U);
}

TEST_F(DataDirTest, AnIndexThatLostItsVersionIsDamaged) {
    ASSERT_TRUE(open());
    {
        auto database = Database::open(directory_ / "sessions.db");
        ASSERT_TRUE(database && database->run("PRAGMA user_version = 0"));
    }
    ASSERT_TRUE(open());
    EXPECT_THAT(told_, HasSubstr("put aside untouched"));
}

TEST_F(DataDirTest, ALaterVersionIsLeftAlone) {
    ASSERT_TRUE(open());
    {
        auto database = Database::open(directory_ / "sessions.db");
        ASSERT_TRUE(database && database->run("CREATE TABLE later (number INTEGER); PRAGMA user_version = 4"));
    }
    const auto opened = open();
    ASSERT_FALSE(opened);
    EXPECT_EQ(opened.error().cause, Cause::kUnsupported);
    EXPECT_THAT(opened.error().message, HasSubstr("has version 4"));
    EXPECT_EQ(told_, "");
    EXPECT_FALSE(std::filesystem::exists(directory_ / "damaged-1"));
}

TEST_F(DataDirTest, ANumberOfAVersionThatChangedIsDamage) {
    ASSERT_TRUE(open());
    ASSERT_TRUE((*Database::open(directory_ / "sessions.db")).run("PRAGMA user_version = 16777219"));
    ASSERT_TRUE(open());
    EXPECT_THAT(told_, HasSubstr("says that its version is 16777219; put aside untouched"));
}

TEST_F(DataDirTest, ALastNumberThatChangedIsDamage) {
    ASSERT_TRUE(open());
    ASSERT_TRUE((*Database::open(directory_ / "sessions.db"))
                    .run("INSERT INTO sqlite_sequence VALUES ('sessions', 9223372036854775807)"));
    const auto opened = open();
    ASSERT_TRUE(opened) << opened.error().message;
    EXPECT_THAT(told_, HasSubstr("the last number is 9223372036854775807; put aside untouched"));
}

TEST_F(DataDirTest, AnIndexThatSaysItCannotBeWrittenIsDamage) {
    ASSERT_TRUE(open());
    {
        std::fstream file(directory_ / "sessions.db", std::ios::in | std::ios::out | std::ios::binary);
        file.seekp(18);
        file.put('\3');
    }
    ASSERT_TRUE(open());
    EXPECT_THAT(told_, HasSubstr("put aside untouched"));
    EXPECT_TRUE((*SqliteSessionIndex::open(directory_ / "sessions.db"))->add_loose("blob"));
}

TEST_F(DataDirTest, AnIndexThatIsMovedAwayKeepsNothingInSilence) {
    ASSERT_TRUE(open());
    const auto index = *SqliteSessionIndex::open(directory_ / "sessions.db");
    ASSERT_TRUE(index->add_loose("blob"));
    for (const char* name : {"sessions.db", "sessions.db-wal"}) {
        std::filesystem::rename(directory_ / name, directory_ / "away");
        const Status kept = index->add_loose("another");
        ASSERT_FALSE(kept) << name;
        EXPECT_EQ(kept.error().cause, Cause::kUnavailable);
        EXPECT_THAT(kept.error().message, HasSubstr("was moved or deleted"));
        std::filesystem::rename(directory_ / "away", directory_ / name);
        EXPECT_TRUE(index->add_loose("another")) << name;
    }
}

TEST_F(DataDirTest, OneThatOthersCanReadIsTold) {
    ASSERT_TRUE(open());
    std::filesystem::permissions(directory_, std::filesystem::perms(0755));
    ASSERT_TRUE(open());
    EXPECT_THAT(told_, HasSubstr("can be read by other users"));
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
        constexpr std::streamoff kPage = 4096;
        file.seekp(8 * kPage);
        file << std::string(std::size_t{3} * kPage, '\xa5');
    }
    ASSERT_TRUE(open());
    EXPECT_THAT(told_, HasSubstr("put aside untouched"));
}

/// An index of 100 sessions with a representation each, seven sessions a page.
class DamagedIndexTest : public DataDirTest {
protected:
    static constexpr std::uint64_t kSessions = 100;

    void SetUp() override {
        ASSERT_TRUE(open());
        {
            const auto index = *SqliteSessionIndex::open(file());
            for (std::uint64_t number = 1; number <= kSessions; ++number) {
                const SessionRow session{
                    number, std::to_string(number), "ann", 0, 5, 0, {std::to_string(number), std::string(500, 'x')}};
                ASSERT_TRUE(index->add_session(session));
                ASSERT_TRUE(index->add_representation({number, 1, {"m" + std::to_string(number), "info"}}, 1));
            }
        }
        std::ifstream stream(file(), std::ios::binary);
        written_ = {std::istreambuf_iterator<char>(stream), {}};
    }

    std::filesystem::path file() const { return directory_ / "sessions.db"; }

    void put(const std::string& bytes) {
        std::filesystem::remove_all(directory_ / "damaged-1");
        for (const char* suffix : {"-wal", "-shm"}) std::filesystem::remove(file().string() + suffix);
        std::ofstream(file(), std::ios::binary) << bytes;
        told_.clear();
    }

    /// Sessions that are served from these bytes.
    std::size_t served_of(const std::string& bytes) {
        put(bytes);
        {
            const auto opened = open();
            EXPECT_TRUE(opened) << opened.error().message;
        }
        const auto contents = (*SqliteSessionIndex::open(file()))->load();
        EXPECT_TRUE(contents) << contents.error().message;
        const auto is_sound = [](const SessionRow& row) { return row.sound; };
        return static_cast<std::size_t>(std::count_if(contents->sessions.begin(), contents->sessions.end(), is_sound));
    }

    std::string written_;
};

TEST_F(DamagedIndexTest, ABitThatChangesLosesAPageOfSessionsAtMost) {
    constexpr std::size_t kStep = 1999;
    for (std::size_t at = 100; at < written_.size(); at += kStep) {
        std::string damaged = written_;
        damaged[at] = static_cast<char>(damaged[at] ^ 1 << at % 8);
        EXPECT_GE(served_of(damaged) + 8, kSessions) << at << ": " << told_;
    }
}

TEST_F(DamagedIndexTest, APageThatIsLostLosesItsSessionsAtMost) {
    constexpr std::size_t kPage = 4096;
    constexpr std::size_t kRoot = 2 * kPage;  // of the table of sessions: what it leads to is not found without it
    for (std::size_t at = 0; at < written_.size(); at += kPage) {
        if (at == kRoot) continue;
        for (const char fill : {'\0', '\xa5'}) {
            std::string damaged = written_;
            damaged.replace(at, kPage, kPage, fill);
            EXPECT_GE(served_of(damaged) + 8, kSessions) << at << ": " << told_;
            EXPECT_FALSE(std::filesystem::exists(directory_ / "sessions.db.copy"));
        }
    }
}

TEST_F(DamagedIndexTest, TheFirstPageThatIsLostLosesNothing) {
    std::string damaged = written_;
    damaged.replace(0, 4096, 4096, '\0');
    EXPECT_EQ(served_of(damaged), kSessions);
    EXPECT_THAT(told_, HasSubstr("100 sessions with 100 representations"));
}

/// However far a server got that was killed while it replaced its index.
TEST_F(DamagedIndexTest, AnEndWhileTheIndexIsReplacedLosesNothing) {
    std::string damaged = written_;
    damaged[damaged.find("made INTEGER")] = 'n';
    // The damaged one was kept, and another one begun.
    put(damaged);
    std::filesystem::create_directories(directory_ / "damaged-1");
    std::filesystem::create_hard_link(file(), directory_ / "damaged-1" / "sessions.db");
    std::ofstream(directory_ / "sessions.db.new", std::ios::binary) << written_.substr(0, 5000);
    std::ofstream(directory_ / "sessions.db.new-wal", std::ios::binary) << "half";
    ASSERT_TRUE(open());
    EXPECT_THAT(told_, HasSubstr("100 sessions with 100 representations"));
    EXPECT_FALSE(std::filesystem::exists(directory_ / "damaged-2")) << "the same files are kept once";
    EXPECT_FALSE(std::filesystem::exists(directory_ / "sessions.db.new"));
    // The new one was ready, and the log of the old one still there, or all of the old one gone.
    for (const bool old_is_there : {true, false}) {
        put(damaged);
        std::ofstream(file().string() + "-wal", std::ios::binary) << std::string(5000, 'x');
        std::ofstream(directory_ / "sessions.db.ready", std::ios::binary) << written_;
        if (!old_is_there) std::filesystem::remove(file());
        ASSERT_TRUE(open());
        EXPECT_EQ(told_, "");
        EXPECT_EQ((*(*SqliteSessionIndex::open(file()))->load()).sessions.size(), kSessions);
        EXPECT_FALSE(std::filesystem::exists(directory_ / "sessions.db.ready"));
    }
}

TEST_F(DamagedIndexTest, ASchemaThatChangedIsDamageAndSessionsComeOver) {
    std::string damaged = written_;
    const std::size_t column = damaged.find("made INTEGER");
    ASSERT_NE(column, std::string::npos);
    damaged[column] = 'n';
    EXPECT_EQ(served_of(damaged), kSessions);
    EXPECT_THAT(told_, HasSubstr("its schema is not as it was written; put aside untouched in "));
    EXPECT_THAT(told_, HasSubstr("100 sessions with 100 representations"));
}

}  // namespace
}  // namespace vsplit::store

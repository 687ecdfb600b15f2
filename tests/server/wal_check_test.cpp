#include "store/wal_check.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <vector>

#include "store/sqlite.h"
#include "tests/temp_directory.h"

namespace vsplit::store {
namespace {

constexpr std::size_t kHeader = 32;
constexpr std::size_t kPage = 512;
constexpr std::size_t kFrame = 24 + kPage;

std::uint64_t lost_of(const std::string& log) { return transactions_lost(std::as_bytes(std::span(log))); }

std::string read(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

/// A database with small pages and a log that holds four transactions of one frame each, and behind them what is left of before.
class WalCheckTest : public ::testing::Test {
protected:
    WalCheckTest() {
        auto database = *Database::open(file());
        run(database, "PRAGMA page_size = 512; PRAGMA journal_mode = WAL; PRAGMA wal_autocheckpoint = 0");
        run(database, "CREATE TABLE t (n INTEGER)");
        for (int i = 0; i < 6; ++i) run(database, "INSERT INTO t VALUES (1)");
        run(database, "PRAGMA wal_checkpoint(RESTART)");
        for (int i = 0; i < 4; ++i) run(database, "INSERT INTO t VALUES (2)");
        log_ = read(scratch_.path() / "t.db-wal");
        database_ = read(file());
    }

    static void run(Database& database, const char* sql) {
        const Status done = database.run(sql);
        ASSERT_TRUE(done) << done.error().message;
    }

    std::filesystem::path file() const { return scratch_.path() / "t.db"; }

    /// Rows that SQLite finds with a log in the place of its own.
    std::int64_t rows_with(const std::string& log) {
        const auto other = scratch_.path() / "other.db";
        std::ofstream(other, std::ios::binary) << database_;
        std::ofstream(other.string() + "-wal", std::ios::binary) << log;
        auto database = *Database::open(other);
        Statement count = database.prepare("SELECT count(*) FROM t");
        EXPECT_TRUE(count.step());
        return count.number(0);
    }

    test::TempDirectory scratch_;
    std::string log_;
    std::string database_;
};

TEST_F(WalCheckTest, ASoundLogLosesNothing) {
    ASSERT_GT(log_.size(), kHeader + 4 * kFrame) << "frames of before are there";
    EXPECT_EQ(rows_with(log_), 10);
    EXPECT_EQ(lost_of(log_), 0U);
}

TEST_F(WalCheckTest, EveryByteOfTheSecondFrameLosesWhatSqliteLoses) {
    for (std::size_t at = kHeader + kFrame; at < kHeader + 2 * kFrame; ++at) {
        std::string damaged = log_;
        damaged[at] = static_cast<char>(damaged[at] ^ 0x10);
        EXPECT_EQ(lost_of(damaged), 2U) << at;
        if (at % 67 != 0) continue;
        EXPECT_EQ(rows_with(damaged), 7) << at;
    }
}

TEST_F(WalCheckTest, EveryByteOfTheHeaderLosesAll) {
    for (std::size_t at = 0; at < kHeader; ++at) {
        std::string damaged = log_;
        damaged[at] = static_cast<char>(damaged[at] ^ 1);
        EXPECT_GE(lost_of(damaged), 1U) << at;
        EXPECT_EQ(rows_with(damaged), 6) << at;
    }
}

TEST_F(WalCheckTest, ATailThatACrashCutShortIsNoDamage) {
    for (std::size_t size = 0; size <= log_.size(); ++size) EXPECT_EQ(lost_of(log_.substr(0, size)), 0U) << size;
    for (std::size_t at = kHeader + 3 * kFrame; at < kHeader + 4 * kFrame; ++at) {
        std::string torn = log_;
        torn[at] = static_cast<char>(torn[at] ^ 1);
        EXPECT_EQ(lost_of(torn), 0U) << at;
    }
}

// Whoever can write the file can make its checksum.
TEST_F(WalCheckTest, APageSizeThatSqliteHasNotIsADamagedHeader) {
    for (const std::uint32_t page : {0U, 1U, 13U, 511U, 1000U, 0x80000000U, 0xFFFFFFFFU}) {
        std::vector<std::uint32_t> words{0x377f0683, 3'007'000, page, 0, 1, 2, 0, 0};
        for (std::size_t at = 0; at < 6; at += 2) {
            words[6] += words[at] + words[7];
            words[7] += words[at + 1] + words[6];
        }
        std::string log;
        for (const std::uint32_t word : words) {
            for (const int shift : {24, 16, 8, 0}) log += static_cast<char>(word >> static_cast<unsigned>(shift));
        }
        EXPECT_EQ(lost_of(log + std::string(200, 'x')), 1U) << page;
    }
}

TEST_F(WalCheckTest, AFileOfZerosIsNoDamage) { EXPECT_EQ(lost_of(std::string(5000, '\0')), 0U); }

}  // namespace
}  // namespace vsplit::store

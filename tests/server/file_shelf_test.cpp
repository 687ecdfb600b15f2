#include "grpc/file_shelf.h"

#include <gtest/gtest.h>

#include <thread>

#include "test_client.h"

namespace vsplit::rpc {
namespace {

using std::chrono::milliseconds;

class FileShelfTest : public ::testing::Test {
protected:
    // A file of so many bytes, on disk.
    static MeshFile file_of(std::size_t bytes) {
        Expected<service::TempFile> file = service::TempFile::create();
        const std::string text(bytes, 'x');
        EXPECT_TRUE(file->append(std::as_bytes(std::span(text))));
        MeshFile made;
        made.facts.size = bytes;
        made.facts.digest = std::to_string(bytes);
        made.mapping.emplace(*file->map());
        return made;
    }

    FileName name(const std::string& text) { return {text, mesh_}; }

    // Makes the file of that name, for a reader who is gone at once.
    void make(FileShelf& shelf, const std::string& text, std::size_t bytes) {
        const auto [file, first] = shelf.join(name(text));
        EXPECT_TRUE(first) << text;
        MeshFile made = file_of(bytes);
        shelf.made(name(text), file, made.facts, FileShelf::Rest::kYes);
        EXPECT_TRUE(shelf.find(name(text))) << "known before anybody is told of it";
        file->put(std::move(made));
    }

    bool lies_there(FileShelf& shelf, const std::string& text) { return !shelf.join(name(text)).second; }

    std::shared_ptr<const int> mesh_ = std::make_shared<const int>(1);
};

TEST_F(FileShelfTest, ReadersOfTheSameShareIt) {
    FileShelf shelf({});
    const auto [one, first] = shelf.join(name("a"));
    const auto [two, second] = shelf.join(name("a"));
    EXPECT_TRUE(first);
    EXPECT_FALSE(second);
    EXPECT_EQ(one, two);
    int woken = 0;
    two->call_when_there([&] { ++woken; });
    EXPECT_EQ(woken, 0);
    one->put(file_of(10));
    EXPECT_EQ(woken, 1);
    EXPECT_TRUE(shelf.join(name("b")).second) << "another name";
}

TEST_F(FileShelfTest, WhatNobodyWaitsForAnyMoreIsNew) {
    FileShelf shelf({});
    EXPECT_TRUE(shelf.join(name("a")).second);
    EXPECT_TRUE(shelf.join(name("a")).second);
}

TEST_F(FileShelfTest, AFileRestsAWhileAndIsKnownAfterwards) {
    FileShelf shelf({milliseconds(200), 1 << 20, 10});
    make(shelf, "a", 10);
    EXPECT_TRUE(lies_there(shelf, "a"));
    {
        const std::shared_ptr<SharedFile> reader = shelf.join(name("a")).first;
        std::this_thread::sleep_for(milliseconds(500));
        EXPECT_TRUE(lies_there(shelf, "a")) << "for as long as it is read";
    }
    EXPECT_TRUE(lies_there(shelf, "a")) << "and a while after that";
    std::this_thread::sleep_for(milliseconds(600));
    ASSERT_TRUE(shelf.find(name("a")));
    EXPECT_EQ(shelf.find(name("a"))->digest, "10");
    EXPECT_FALSE(lies_there(shelf, "a"));
}

TEST_F(FileShelfTest, WhatRestsTakesNoMoreThanItMay) {
    FileShelf shelf({std::chrono::hours(1), 100, 10});
    make(shelf, "a", 60);
    make(shelf, "b", 30);
    EXPECT_TRUE(lies_there(shelf, "a"));
    make(shelf, "c", 40);
    // When "c" was made its maker held it still; the next that is made finds it unread.
    make(shelf, "d", 10);
    EXPECT_TRUE(lies_there(shelf, "a")) << "read last";
    EXPECT_FALSE(lies_there(shelf, "b")) << "unread for longest";
    shelf.clear();
    EXPECT_FALSE(lies_there(shelf, "a"));
    EXPECT_TRUE(shelf.find(name("c")));
}

TEST_F(FileShelfTest, FilesThatAreKnownAreLimitedToo) {
    FileShelf shelf({milliseconds(50), 1 << 20, 3});
    for (int i = 0; i < 10; ++i) make(shelf, std::to_string(i), 10);
    EXPECT_TRUE(test::eventually([&] { return !shelf.find(name("0")); }));
    EXPECT_TRUE(shelf.find(name("9")));
}

TEST_F(FileShelfTest, AnotherMeshIsAnotherFile) {
    FileShelf shelf({});
    make(shelf, "a", 10);
    mesh_ = std::make_shared<const int>(2);
    EXPECT_FALSE(shelf.find(name("a")));
    EXPECT_FALSE(lies_there(shelf, "a"));
}

TEST_F(FileShelfTest, WhereTheDiskIsShortNothingRests) {
    FileShelf shelf({});
    {
        const auto [file, first] = shelf.join(name("a"));
        MeshFile made = file_of(10);
        shelf.made(name("a"), file, made.facts, FileShelf::Rest::kNo);
        file->put(std::move(made));
        EXPECT_TRUE(lies_there(shelf, "a")) << "while it is read";
    }
    EXPECT_FALSE(lies_there(shelf, "a"));
    EXPECT_TRUE(shelf.find(name("a"))) << "but it is known";
}

TEST_F(FileShelfTest, AFailureIsNotKept) {
    FileShelf shelf({});
    {
        const std::shared_ptr<SharedFile> file = shelf.join(name("a")).first;
        file->put(Error{Cause::kLimitExceeded, "no memory", ""});
    }
    EXPECT_FALSE(shelf.find(name("a")));
    EXPECT_FALSE(lies_there(shelf, "a"));
}

}  // namespace
}  // namespace vsplit::rpc

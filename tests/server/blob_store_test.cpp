#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <fstream>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "store/file_blob_store.h"
#include "store/mesh_blob.h"
#include "tests/core/meshes.h"
#include "tests/temp_directory.h"

namespace vsplit::store {
namespace {

using ::testing::HasSubstr;

Bytes bytes_of(std::string_view text) { return std::as_bytes(std::span(text)); }

std::string text_of(Bytes bytes) { return {reinterpret_cast<const char*>(bytes.data()), bytes.size()}; }

class FileBlobStoreTest : public ::testing::Test {
protected:
    std::unique_ptr<FileBlobStore> open(std::uint64_t quota = 0) {
        auto store = FileBlobStore::open(scratch_.path() / "blobs", quota);
        EXPECT_TRUE(store) << store.error().message;
        return *std::move(store);
    }

    static Expected<BlobEntry> put(FileBlobStore& store, std::string_view text) {
        const Bytes bytes = bytes_of(text);
        return store.put({&bytes, 1});
    }

    std::filesystem::path file_of(const std::string& key) const { return scratch_.path() / "blobs" / key.substr(0, 2) / key; }

    test::TempDirectory scratch_;
};

TEST_F(FileBlobStoreTest, GivesBackWhatItKeepsAlsoAfterItIsOpenedAnew) {
    const std::string large(1'000'000, 'x');
    BlobEntry blob;
    {
        const auto store = open();
        const std::vector<Bytes> parts{bytes_of("head"), bytes_of(large)};
        const auto kept = store->put(parts);
        ASSERT_TRUE(kept) << kept.error().message;
        EXPECT_EQ(kept->bytes, 1'000'004U);
        blob = *kept;
    }
    const auto store = open();
    EXPECT_EQ(store->bytes(), 1'000'004U);
    const auto found = store->get(blob);
    ASSERT_TRUE(found) << found.error().message;
    EXPECT_EQ(text_of((*found)->bytes()), "head" + large);
}

TEST_F(FileBlobStoreTest, ABlobThatCannotBeReadJustNowStays) {
    const auto store = open();
    const auto kept = put(*store, "a mesh");
    ASSERT_TRUE(kept);
    rlimit before{};
    ASSERT_EQ(getrlimit(RLIMIT_NOFILE, &before), 0);
    rlimit none = before;
    none.rlim_cur = 0;  // no descriptor is free
    ASSERT_EQ(setrlimit(RLIMIT_NOFILE, &none), 0);
    const auto again = put(*store, "a mesh");
    ASSERT_EQ(setrlimit(RLIMIT_NOFILE, &before), 0);
    ASSERT_FALSE(again);
    EXPECT_THAT(again.error().message, HasSubstr("Too many open files"));
    EXPECT_TRUE(store->get(*kept));
}

TEST_F(FileBlobStoreTest, TheSameBytesAreKeptOnce) {
    const auto store = open();
    const auto first = put(*store, "twice");
    const auto second = put(*store, "twice");
    ASSERT_TRUE(first && second);
    EXPECT_EQ(first->key, second->key);
    EXPECT_EQ(store->bytes(), 5U);
    EXPECT_EQ(store->list()->size(), 1U);
}

TEST_F(FileBlobStoreTest, ABlobOutlivesItsRemoval) {
    const auto store = open();
    const BlobEntry blob = *put(*store, "gone");
    const std::string& key = blob.key;
    const auto held = store->get(blob);
    ASSERT_TRUE(held);
    ASSERT_TRUE(store->remove(key));
    ASSERT_TRUE(store->remove(key)) << "it is removed already";
    EXPECT_EQ(text_of((*held)->bytes()), "gone");
    EXPECT_EQ(store->bytes(), 0U);
    EXPECT_EQ(store->get(blob).error().cause, Cause::kCorrupt);
}

TEST_F(FileBlobStoreTest, ChangedAndShortenedBytesAreNotServed) {
    const auto store = open();
    const BlobEntry blob = *put(*store, "as it was");
    const std::string& key = blob.key;
    std::ofstream(file_of(key), std::ios::in | std::ios::out).write("AS", 2);
    const auto changed = store->get(blob);
    ASSERT_FALSE(changed);
    EXPECT_EQ(changed.error().cause, Cause::kCorrupt);
    EXPECT_THAT(changed.error().message, HasSubstr(key));
    std::filesystem::resize_file(file_of(key), 3);
    EXPECT_EQ(store->get(blob).error().cause, Cause::kCorrupt);
    std::filesystem::resize_file(file_of(key), 0);
    EXPECT_EQ(store->get(blob).error().cause, Cause::kCorrupt);
    ASSERT_TRUE(put(*store, "as it was")) << "a damaged one is written anew";
    EXPECT_TRUE(store->get(blob));
    std::ofstream(file_of(key), std::ios::in | std::ios::out).write("AS", 2);
    ASSERT_TRUE(put(*store, "as it was")) << "also where its size is right";
    EXPECT_TRUE(store->get(blob));
    EXPECT_TRUE(std::filesystem::exists(scratch_.path() / "blobs" / "aside" / (key + ".blob"))) << "the damaged one is kept";
}

TEST_F(FileBlobStoreTest, ABlobThatIsReadAlreadyMayBeCutShort) {
    const auto store = open();
    const std::string large(1'000'000, 'x');
    const BlobEntry blob = *put(*store, large);
    const std::string& key = blob.key;
    const auto held = store->get(blob);
    ASSERT_TRUE(held) << held.error().message;
    std::filesystem::resize_file(file_of(key), 0);
    EXPECT_EQ(text_of((*held)->bytes()), large);
}

TEST_F(FileBlobStoreTest, ADirectoryInABlobsPlaceIsDamageLikeAnyOther) {
    const auto store = open();
    const BlobEntry blob = *put(*store, "a file");
    const std::string& key = blob.key;
    std::filesystem::remove(file_of(key));
    std::filesystem::create_directory(file_of(key));
    EXPECT_EQ(store->get(blob).error().cause, Cause::kCorrupt);
    EXPECT_TRUE(store->list()->empty());
    ASSERT_TRUE(put(*store, "a file"));
    EXPECT_TRUE(store->get(blob));
    EXPECT_EQ(open()->bytes(), 6U);
}

TEST_F(FileBlobStoreTest, APipeInABlobsPlaceIsNotWaitedFor) {
    const auto store = open();
    const BlobEntry blob = *put(*store, "a file");
    std::filesystem::remove(file_of(blob.key));
    ASSERT_EQ(mkfifo(file_of(blob.key).c_str(), 0600), 0);
    EXPECT_EQ(store->get(blob).error().cause, Cause::kCorrupt);
    ASSERT_TRUE(put(*store, "a file"));
    EXPECT_TRUE(store->get(blob));
    EXPECT_EQ(store->aside(), 1U);
}

// Otherwise whoever makes a file larger has all of it read into memory.
TEST_F(FileBlobStoreTest, ABlobThatGrewIsNotRead) {
    const auto store = open();
    const BlobEntry blob = *put(*store, "a file");
    std::filesystem::resize_file(file_of(blob.key), std::uintmax_t{1} << 40);
    EXPECT_THAT(store->get(blob).error().message, HasSubstr("has 1099511627776 bytes instead of 6"));
}

TEST_F(FileBlobStoreTest, APlaceThatCannotBeLookedAtIsRefusedWithoutItsPath) {
    const auto store = open();
    const Bytes bytes = bytes_of("some bytes");
    const auto place = scratch_.path() / "blobs" / store->key_of({&bytes, 1}).substr(0, 2);
    std::filesystem::create_symlink(place, place);
    const auto put = store->put({&bytes, 1});
    ASSERT_FALSE(put);
    EXPECT_EQ(put.error().cause, Cause::kUnavailable);
    EXPECT_EQ(put.error().message, "cannot keep a mesh in the data directory: Too many levels of symbolic links");
}

TEST_F(FileBlobStoreTest, WhatIsPutAsideIsThereAndNotServed) {
    const auto store = open();
    const BlobEntry blob = *put(*store, "perhaps all that is left");
    const std::string& key = blob.key;
    ASSERT_TRUE(store->put_aside(key));
    EXPECT_FALSE(store->get(blob));
    EXPECT_TRUE(store->list()->empty());
    EXPECT_EQ(store->bytes(), 0U);
    EXPECT_TRUE(std::filesystem::exists(scratch_.path() / "blobs" / "aside" / (key + ".blob")));
    EXPECT_TRUE(open()->list()->empty());
}

TEST_F(FileBlobStoreTest, HalfWrittenFilesAreNoBlobsAndGo) {
    open();
    const auto half = scratch_.path() / "blobs" / "incoming" / "7";
    std::ofstream(half) << "half";
    EXPECT_TRUE(open()->list()->empty());
    EXPECT_FALSE(std::filesystem::exists(half));
}

TEST_F(FileBlobStoreTest, TheQuotaIsCheckedBeforeAnythingIsWritten) {
    const auto store = open(10);
    ASSERT_TRUE(put(*store, "123456"));
    const auto refused = put(*store, "12345");
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().cause, Cause::kLimitExceeded);
    EXPECT_THAT(refused.error().message, HasSubstr("max_disk_bytes, 10"));
    EXPECT_EQ(store->bytes(), 6U);
    EXPECT_TRUE(put(*store, "123456")) << "it is there already";
    EXPECT_TRUE(put(*store, "1234"));
    EXPECT_EQ(open(10)->bytes(), 10U);
}

TEST_F(FileBlobStoreTest, ThreadsPutTheSameAndOthers) {
    const auto store = open();
    std::vector<std::thread> threads;
    for (int t = 0; t < 4; ++t) {
        threads.emplace_back([&] {
            for (int i = 0; i < 20; ++i) {
                const std::string text = "blob " + std::to_string(i);
                const auto blob = put(*store, text);
                ASSERT_TRUE(blob) << blob.error().message;
                EXPECT_EQ(text_of((*store->get(*blob))->bytes()), text);
            }
        });
    }
    for (std::thread& thread : threads) thread.join();
    EXPECT_EQ(store->list()->size(), 20U);
    EXPECT_EQ(store->bytes(), 10U * 6 + 10U * 7) << "each is counted once";
}

TEST(MeshBlobTest, ReadsWhatItWrote) {
    TriangleMesh mesh = test::icosphere(2);
    for (std::uint32_t face = 0; face < mesh.face_count(); ++face) mesh.regions.push_back(face % 3);
    for (const TriangleMesh& one : {mesh, test::cube(), TriangleMesh()}) {
        const MeshBlob blob(one);
        std::string all;
        for (const Bytes part : blob.parts()) all += text_of(part);
        const auto read = read_mesh_blob(bytes_of(all));
        ASSERT_TRUE(read) << read.error().message;
        EXPECT_EQ(*read, one);
    }
}

TEST(MeshBlobTest, EveryShorterOneAndEveryChangedSizeIsCorrupt) {
    const TriangleMesh cube = test::cube();
    const MeshBlob blob(cube);
    std::string all;
    for (const Bytes part : blob.parts()) all += text_of(part);
    for (std::size_t size = 0; size < all.size(); ++size) {
        EXPECT_EQ(read_mesh_blob(bytes_of(all).first(size)).error().cause, Cause::kCorrupt) << size;
    }
    for (std::size_t at = 0; at < 24; ++at) {
        std::string changed = all;
        changed[at] = static_cast<char>(changed[at] ^ 0x40);
        EXPECT_FALSE(read_mesh_blob(bytes_of(changed))) << at;
    }
    std::string beyond = all;
    beyond[beyond.size() - 1] = 0x7f;  // of an index
    EXPECT_THAT(read_mesh_blob(bytes_of(beyond)).error().message, HasSubstr("a vertex that is none"));
}

}  // namespace
}  // namespace vsplit::store

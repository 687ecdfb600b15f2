#include "service/lru_cache.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <thread>
#include <vector>

namespace vsplit::service {
namespace {

class LruCacheTest : public ::testing::Test {
protected:
    std::string get(std::size_t key) {
        if (const auto found = cache_.find(key)) return *found;
        ++made_;
        return *cache_.insert(key, std::make_shared<const std::string>(std::to_string(key)));
    }

    LruCache<std::string> cache_{2};
    int made_ = 0;
};

TEST_F(LruCacheTest, MakesAValueOnce) {
    EXPECT_EQ(get(7), "7");
    EXPECT_EQ(get(7), "7");
    EXPECT_EQ(made_, 1);
}

TEST_F(LruCacheTest, DropsWhatWasUsedLongestAgo) {
    for (const std::size_t key : {1, 2, 1, 3}) EXPECT_EQ(get(key), std::to_string(key));
    EXPECT_EQ(made_, 3);
    EXPECT_EQ(get(1), "1");
    EXPECT_EQ(made_, 3) << "1 was used after 2";
    EXPECT_EQ(get(2), "2");
    EXPECT_EQ(made_, 4) << "2 had gone";
}

TEST_F(LruCacheTest, AValueOutlivesItsPlace) {
    const auto held = cache_.insert(1, std::make_shared<const std::string>("one"));
    for (const std::size_t key : {2, 3, 4}) EXPECT_EQ(get(key), std::to_string(key));
    EXPECT_EQ(*held, "one");
}

TEST_F(LruCacheTest, TheFirstValueOfAKeyStays) {
    const auto first = cache_.insert(1, std::make_shared<const std::string>("first"));
    EXPECT_EQ(cache_.insert(1, std::make_shared<const std::string>("second")), first);
}

TEST(LruCacheThreadsTest, ThreadsGetTheValueOfTheirKey) {
    LruCache<std::size_t> cache(3);
    std::vector<std::thread> threads;
    for (std::size_t t = 0; t < 4; ++t) {
        threads.emplace_back([&cache, t] {
            for (std::size_t i = 0; i < 1000; ++i) {
                const std::size_t key = (i * 7 + t) % 6;
                auto value = cache.find(key);
                if (!value) value = cache.insert(key, std::make_shared<const std::size_t>(key * 100));
                EXPECT_EQ(*value, key * 100);
            }
        });
    }
    for (std::thread& thread : threads) thread.join();
}

}  // namespace
}  // namespace vsplit::service

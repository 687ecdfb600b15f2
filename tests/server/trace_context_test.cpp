#include "wire/trace_context.h"

#include <gtest/gtest.h>

#include <string>
#include <tuple>

namespace vsplit::wire {
namespace {

const std::string kExample = "00-0af7651916cd43dd8448eb211c80319c-b7ad6b7169203331-01";  // W3C Trace Context, 3.2

TEST(TraceContextTest, ReadsTheRecommendationsExample) {
    const auto trace = parse_traceparent(kExample);
    ASSERT_TRUE(trace);
    EXPECT_EQ(trace->trace_id, "0af7651916cd43dd8448eb211c80319c");
    EXPECT_EQ(trace->span_id, "b7ad6b7169203331");
    EXPECT_EQ(trace->flags, "01");
    EXPECT_EQ(to_traceparent(*trace), kExample);
}

TEST(TraceContextTest, ReadsALaterVersionThatHasMore) {
    EXPECT_TRUE(parse_traceparent("cc" + kExample.substr(2) + "-what-the-future-brings"));
    EXPECT_FALSE(parse_traceparent("cc" + kExample.substr(2) + ".what"));
    EXPECT_FALSE(parse_traceparent(kExample + "-more"));
    EXPECT_FALSE(parse_traceparent("ff" + kExample.substr(2)));
}

TEST(TraceContextTest, PassesOnTheBitThatIsDefinedAlone) {
    const std::string whose = kExample.substr(2, 51);
    for (const auto& [version, flags, passed] :
         {std::tuple("00", "ff", "01"), {"00", "fe", "00"}, {"01", "0b", "01"}, {"00", "02", "00"}}) {
        const auto trace = parse_traceparent(version + whose + flags);
        ASSERT_TRUE(trace) << version << whose << flags;
        EXPECT_EQ(trace->flags, passed) << version << ' ' << flags;
    }
}

TEST(TraceContextTest, TakesNothingThatIsBroken) {
    EXPECT_FALSE(parse_traceparent("00-" + std::string(32, '0') + kExample.substr(35)));
    EXPECT_FALSE(parse_traceparent(kExample.substr(0, 36) + std::string(16, '0') + "-01"));
    for (std::size_t i = 0; i < kExample.size(); ++i) {
        EXPECT_FALSE(parse_traceparent(kExample.substr(0, i))) << i;
        for (const char wrong : {'G', 'A', ' ', '\0', '-'}) {
            std::string broken = kExample;
            if (broken[i] == wrong) continue;
            broken[i] = wrong;
            EXPECT_FALSE(parse_traceparent(broken)) << i << ' ' << wrong;
        }
    }
}

TEST(TraceContextTest, KnowsARequestId) {
    EXPECT_TRUE(is_request_id("job-7_A.z"));
    EXPECT_TRUE(is_request_id(std::string(64, 'a')));
    for (const std::string& wrong :
         {std::string(), std::string(65, 'a'), std::string("a b"), std::string("a\nb"), std::string("\"")})
        EXPECT_FALSE(is_request_id(wrong)) << wrong;
}

}  // namespace
}  // namespace vsplit::wire

// What the REST door reads in text: paths, queries, and the header fields that ask for something.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <string>

#include "rest/accept.h"
#include "rest/byte_range.h"
#include "rest/conditions.h"
#include "rest/cors.h"
#include "rest/path_template.h"
#include "rest/percent.h"
#include "rest/target.h"

namespace vsplit::rest {
namespace {

std::string matched(const char* pattern, const char* path) {
    const Expected<PathTemplate> parsed = PathTemplate::parse(pattern);
    if (!parsed) return "no template";
    const auto variables = parsed->match(path);
    if (!variables) return "no match";
    std::string text;
    for (const PathVariable& variable : *variables) text += variable.field + '=' + variable.value + ';';
    return text;
}

TEST(PathTemplateTest, TakesVariablesFromThePath) {
    EXPECT_EQ(matched("/v1/sessions", "/v1/sessions"), "");
    EXPECT_EQ(matched("/v1/sessions/{session}", "/v1/sessions/abc"), "session=abc;");
    EXPECT_EQ(matched("/v1/sessions/{session}:improve", "/v1/sessions/abc:improve"), "session=abc;");
    EXPECT_EQ(matched("/v1/{name=a/*}/x", "/v1/a/b/x"), "name=a/b;");
    EXPECT_EQ(matched("/v1/{name=**}", "/v1/a/b/c"), "name=a/b/c;");
    EXPECT_EQ(matched("/v1/*/{b.c}", "/v1/x/y"), "b.c=y;");
}

TEST(PathTemplateTest, EncodedSeparatorsSeparateNothing) {
    EXPECT_EQ(matched("/v1/{a}", "/v1/x%2Fy"), "a=x/y;");
    EXPECT_EQ(matched("/v1/{a}:go", "/v1/x%3Ago"), "no match");
    EXPECT_EQ(matched("/v1/{a}", "/v1/%zz"), "no match");
}

TEST(PathTemplateTest, RefusesOtherPaths) {
    for (const char* path : {"", "/", "/v1", "/v1/", "/v1//", "/v1/a/b", "v1/a", "/V1/a", "/v1/../v1/a"}) {
        EXPECT_EQ(matched("/v1/{a}", path), "no match") << path;
    }
}

TEST(PathTemplateTest, RefusesWhatIsNoTemplate) {
    for (const char* text :
         {"", "/", "v1", "/v1/", "/{", "/{}", "/{a", "/a}", "/**/a", "/{a=}", "/{a=b/}", "/a:", "/a*", "/{a}{b}"}) {
        EXPECT_FALSE(PathTemplate::parse(text)) << text;
    }
}

TEST(TargetTest, TakesPathAndQueryApart) {
    const Expected<Target> target = parse_target("http://host:1/a/b?x=1&y=a+b%26&flag&&z=%C3%A9#f");
    ASSERT_TRUE(target);
    EXPECT_EQ(target->path, "/a/b");
    ASSERT_EQ(target->query.size(), 4U);
    EXPECT_EQ(target->query[1].value, "a b&");
    EXPECT_EQ(target->query[2].name, "flag");
    EXPECT_EQ(target->query[3].value, "\xC3\xA9");
    EXPECT_EQ(parse_target("HTTP://host/a")->path, "/a");
    for (const char* bad : {"", "*", "a", "host:80", "/?a=%", "/?%g0"}) EXPECT_FALSE(parse_target(bad)) << bad;
    std::string many = "/?";
    for (int i = 0; i < 1001; ++i) many += "a&";
    EXPECT_FALSE(parse_target(many));
}

TEST(AcceptTest, ChoosesWhatIsPreferred) {
    constexpr std::array<std::string_view, 3> kOffers{"application/json", "application/x-ndjson", "application/x-vsplit"};
    EXPECT_EQ(choose_media_type("", kOffers), 0U);
    EXPECT_EQ(choose_media_type("*/*", kOffers), 0U);
    EXPECT_EQ(choose_media_type("Application/X-Ndjson", kOffers), 1U);
    EXPECT_EQ(choose_media_type("application/*;q=0.1, application/x-vsplit;q=0.2", kOffers), 2U);
    EXPECT_EQ(choose_media_type("*/*, application/json;q=0", kOffers), 1U);
    EXPECT_EQ(choose_media_type("text/html", kOffers), std::nullopt);
    EXPECT_EQ(choose_media_type("application/json;q=x", kOffers), std::nullopt);
    EXPECT_TRUE(accepts_encoding("br, GZIP;q=0.5", "gzip"));
    EXPECT_FALSE(accepts_encoding("br, gzip;q=0", "gzip"));
    EXPECT_FALSE(accepts_encoding("", "gzip"));
}

TEST(ByteRangeTest, ReadsOneRange) {
    const auto text = [](const char* header, std::uint64_t size) {
        const ByteRange range = parse_range(header, size);
        if (range.kind == ByteRange::Kind::kWhole) return std::string("whole");
        if (range.kind == ByteRange::Kind::kUnsatisfiable) return std::string("none");
        return std::to_string(range.first) + '-' + std::to_string(range.last);
    };
    EXPECT_EQ(text("bytes=0-0", 10), "0-0");
    EXPECT_EQ(text("bytes=2-", 10), "2-9");
    EXPECT_EQ(text("bytes=-3", 10), "7-9");
    EXPECT_EQ(text("bytes=-30", 10), "0-9");
    EXPECT_EQ(text("bytes=5-99999999999999999999", 10), "5-9") << "as far as there is anything";
    EXPECT_EQ(text("bytes=-99999999999999999999", 10), "0-9");
    EXPECT_EQ(text("bytes=99999999999999999999-", 10), "none");
    EXPECT_EQ(text("bytes=18446744073709551616-3", 10), "whole") << "ends before it begins";
    EXPECT_EQ(text("Bytes=0-3", 10), "0-3");
    EXPECT_EQ(text("BYTES = 0-3", 10), "0-3");
    EXPECT_EQ(text("bytes=, 0-3 ,", 10), "0-3") << "a list of one";
    EXPECT_EQ(text("bytes=5-99", 10), "5-9");
    EXPECT_EQ(text("bytes=10-", 10), "none");
    EXPECT_EQ(text("bytes=-0", 10), "none");
    for (const char* passed_over : {"", "items=0-1", "bytes=", "bytes=-", "bytes=3-2", "bytes=0-1,3-4", "bytes=a-b", "bytes",
                                    "bytes=+1-2", "bytes=0x1-2", "bytes=1-2-3"}) {
        EXPECT_EQ(text(passed_over, 10), "whole") << passed_over;
    }
}

TEST(ConditionsTest, AreJudgedByTheEntityTag) {
    const std::string tag = entity_tag("abc", "");
    EXPECT_EQ(tag, "\"abc\"");
    EXPECT_EQ(entity_tag("abc", "gzip"), "\"abc-gzip\"");
    for (const char* held : {"\"abc\"", "W/\"abc\"", "*", "\"x\", \"abc\"", "\"a,b\" ,W/\"abc\",", "\"x\"\"abc\""}) {
        EXPECT_EQ(judge("", held, tag), Condition::kNotModified) << held;
    }
    for (const char* other :
         {"", "abc", "\"abc", "\"ABC\"", "\"abc-gzip\"", "w/\"abc\"", "W/abc", "W/", ",", "\"", "x, \"abc\""}) {
        EXPECT_EQ(judge("", other, tag), Condition::kHolds) << other;
    }
    EXPECT_EQ(judge("\"abc\"", "", tag), Condition::kHolds);
    EXPECT_EQ(judge("*", "", tag), Condition::kHolds);
    EXPECT_EQ(judge("\"x\"", "\"abc\"", tag), Condition::kFailed) << "If-Match comes first";
    EXPECT_EQ(judge("W/\"abc\"", "", tag), Condition::kFailed) << "a weak one is good for no part";
    EXPECT_TRUE(range_holds("", tag));
    EXPECT_TRUE(range_holds(tag, tag));
    for (const char* other : {"\"x\"", "W/\"abc\"", "*", "Sat, 29 Oct 1994 19:43:31 GMT"})
        EXPECT_FALSE(range_holds(other, tag)) << other;
}

TEST(CorsTest, AHostIsItsOwnByAddressAndByNamesThatAreAllowed) {
    for (const char* own :
         {"", "127.0.0.1", "127.0.0.1:8080", "[::1]:8080", "[::1]", "localhost", "LocalHost:1", "a.localhost:80", "10.1.2.3"}) {
        EXPECT_TRUE(is_own_host(own, {})) << own;
    }
    for (const char* other : {"evil.example", "evil.example:8080", "127.0.0.1.evil.example", "localhost.evil.example",
                              "xlocalhost", ":80", "a b", "0x7f.1"}) {
        EXPECT_FALSE(is_own_host(other, {})) << other;
    }
    const std::array<std::string, 2> allowed{"https://mesh.example", "http://mesh.example:81"};
    EXPECT_TRUE(is_own_host("Mesh.example", allowed));
    EXPECT_TRUE(is_own_host("mesh.example:81", allowed));
    EXPECT_FALSE(is_own_host("mesh.example:82", allowed));
    const std::array<std::string, 1> any{"*"};
    EXPECT_TRUE(is_own_host("evil.example", any));
}

TEST(PercentTest, Decodes) {
    EXPECT_EQ(percent_decode("a%20b%00"), std::string("a b\0", 4));
    EXPECT_EQ(percent_decode("%"), std::nullopt);
    EXPECT_EQ(percent_decode("%4"), std::nullopt);
}

}  // namespace
}  // namespace vsplit::rest

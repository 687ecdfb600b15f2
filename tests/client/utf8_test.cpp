#include "wire/utf8.h"

#include <gtest/gtest.h>

#include <string>

namespace vsplit::wire {
namespace {

TEST(Utf8Test, KeepsWhatIsValid) {
    const std::string text = "plain, \xc3\xa9, \xe2\x82\xac, \xf0\x9f\x9a\x80";
    EXPECT_EQ(valid_utf8(text, 1000), text);
    EXPECT_EQ(valid_utf8("", 1000), "");
}

TEST(Utf8Test, ReplacesEachByteOfNoValidSequence) {
    EXPECT_EQ(valid_utf8("a\xff z", 1000), "a? z");
    EXPECT_EQ(valid_utf8("\x80", 1000), "?");
    EXPECT_EQ(valid_utf8("cut \xe2\x82", 1000), "cut ??");
    EXPECT_EQ(valid_utf8("\xc0\xaf", 1000), "??");            // overlong
    EXPECT_EQ(valid_utf8("\xe0\x80\xaf", 1000), "???");       // overlong
    EXPECT_EQ(valid_utf8("\xed\xa0\x80", 1000), "???");       // surrogate
    EXPECT_EQ(valid_utf8("\xf4\x90\x80\x80", 1000), "????");  // above U+10FFFF
}

TEST(Utf8Test, CutsAtASequenceAndSaysSo) {
    EXPECT_EQ(valid_utf8("0123456789", 10), "0123456789");
    EXPECT_EQ(valid_utf8("0123456789a", 10), "0123456...");
    EXPECT_EQ(valid_utf8("012345\xe2\x82\xac\xe2\x82\xac", 10), "012345...");
    EXPECT_EQ(valid_utf8("abcd", 3), "...");
}

TEST(Utf8Test, NeverExceedsItsLimit) {
    for (std::size_t limit = 3; limit < 40; ++limit) {
        for (std::size_t length = 0; length < 20; ++length) {
            std::string text;
            for (std::size_t i = 0; i < length; ++i) text += "\xe2\x82\xac";
            EXPECT_LE(valid_utf8(text, limit).size(), limit);
        }
    }
}

}  // namespace
}  // namespace vsplit::wire

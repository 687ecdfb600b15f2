#include "guard/token_file.h"

#include <gtest/gtest.h>

#include <string>

namespace vsplit::guard {
namespace {

const std::string kAbc = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";  // SHA-256 of "abc", FIPS 180-4

std::string refusal(const std::string& text) {
    const auto tokens = parse_token_file(text, "tokens");
    return tokens ? "" : tokens.error().message;
}

TEST(TokenFileTest, ReadsNamesAccessAndHashes) {
    const auto tokens = parse_token_file(
        "# who\n\nann read-write " + kAbc + "  # her laptop\r\n\tbob.2 read-only " + std::string(64, 'F'), "tokens");
    ASSERT_TRUE(tokens);
    ASSERT_EQ(tokens->size(), 2U);
    EXPECT_EQ((*tokens)[0].name, "ann");
    EXPECT_EQ((*tokens)[0].access, Access::kWrite);
    EXPECT_EQ((*tokens)[0].digest, digest_of("abc"));
    EXPECT_EQ((*tokens)[1].name, "bob.2");
    EXPECT_EQ((*tokens)[1].access, Access::kRead);
    EXPECT_EQ((*tokens)[1].digest.back(), 0xff);
}

TEST(TokenFileTest, ReadsWhatItWrites) {
    const Token token{"a-name", Access::kRead, digest_of("some token")};
    const auto read = parse_token_file(token_line(token), "tokens");
    ASSERT_TRUE(read);
    EXPECT_EQ(read->front().name, token.name);
    EXPECT_EQ(read->front().access, token.access);
    EXPECT_EQ(read->front().digest, token.digest);
}

TEST(TokenFileTest, SaysWhichLineIsWrongAndNeverWhatIsInIt) {
    const std::string secret = "vst_0123456789abcdef";
    const std::string ann = "ann read-write ";
    const std::string secret_first = secret + " " + kAbc, secret_last = kAbc + " " + secret;
    for (const std::string& line :
         {secret, ann + secret, "ann " + secret_first, ann + kAbc.substr(1), ann + secret_last, "an/n read-write " + kAbc,
          "ann write " + kAbc, std::string(65, 'n') + " read-only " + kAbc}) {
        const std::string message = refusal("\nok read-only " + std::string(64, '0') + "\n" + line + "\n");
        EXPECT_NE(message.find("tokens, line 3: "), std::string::npos) << line << ": " << message;
        EXPECT_EQ(message.find(secret), std::string::npos) << message;
    }
}

TEST(TokenFileTest, TakesANameTwiceButNoHash) {
    EXPECT_EQ(refusal("ann read-write " + kAbc + "\nann read-only " + std::string(64, '1')), "");
    EXPECT_NE(refusal("ann read-write " + kAbc + "\nbob read-only " + kAbc).find("line 2: the hash was used before"),
              std::string::npos);
}

TEST(TokenFileTest, RefusesAFileThatIsEmptyOrHuge) {
    EXPECT_EQ(parse_token_file("# none\n", "tokens").error().cause, Cause::kEmptyInput);
    EXPECT_EQ(parse_token_file(std::string(kMostTokenFileBytes + 1, '#'), "tokens").error().cause, Cause::kLimitExceeded);
}

}  // namespace
}  // namespace vsplit::guard

#include "ops/server_options.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "guard/token_file.h"
#include "ops/exposure.h"
#include "ops/new_token.h"

namespace vsplit::ops {
namespace {

using Variables = std::map<std::string, std::string>;

class ServerOptionsTest : public ::testing::Test {
protected:
    ~ServerOptionsTest() override { std::filesystem::remove(file_); }

    void write(const std::string& text) const { std::ofstream(file_) << text; }

    // The options, or the status to exit with.
    std::variant<ServerOptions, int> parse(const std::vector<std::string>& arguments, const Variables& variables = {}) {
        std::vector<const char*> argv{"vsplitd"};
        for (const std::string& argument : arguments) argv.push_back(argument.c_str());
        ::testing::internal::CaptureStdout();
        ::testing::internal::CaptureStderr();
        auto parsed = parse_server_options(static_cast<int>(argv.size()), argv.data(), [&](const std::string& name) {
            const auto found = variables.find(name);
            return found == variables.end() ? std::nullopt : std::optional<std::string>(found->second);
        });
        said_ = ::testing::internal::GetCapturedStdout();
        errors_ = ::testing::internal::GetCapturedStderr();
        return parsed;
    }

    ServerOptions options(const std::vector<std::string>& arguments, const Variables& variables = {}) {
        const auto parsed = parse(arguments, variables);
        EXPECT_TRUE(std::holds_alternative<ServerOptions>(parsed)) << errors_;
        return std::holds_alternative<ServerOptions>(parsed) ? std::get<ServerOptions>(parsed) : ServerOptions();
    }

    bool refused(const std::vector<std::string>& arguments, const Variables& variables = {}) {
        const auto parsed = parse(arguments, variables);
        return std::holds_alternative<int>(parsed) && std::get<int>(parsed) == 1 && !errors_.empty();
    }

    const std::string file_ = ::testing::TempDir() + "server_options_" + std::to_string(getpid()) + ".toml";
    std::string said_;
    std::string errors_;
};

TEST_F(ServerOptionsTest, FileYieldsToEnvironmentAndThatToFlags) {
    write("max-sessions = 11\nmax-faces = 12\nmax-rpcs = 13\nhttp = \"off\"\ncors-origin = [\"https://a.example\"]\n");
    const Variables variables{{"VSPLITD_MAX_FACES", "22"},
                              {"VSPLITD_MAX_RPCS", "23"},
                              {"VSPLITD_CORS_ORIGIN", "https://b.example,https://c.example"},
                              {"VSPLITD_INSECURE", "true"}};
    const ServerOptions held = options({"--config", file_, "--max-rpcs", "33"}, variables);
    EXPECT_EQ(held.service.limits.sessions, 11U);
    EXPECT_EQ(held.service.limits.faces, 22U);
    EXPECT_EQ(held.max_rpcs, 33U);
    EXPECT_EQ(held.http, "off");
    EXPECT_EQ(held.rest.cors_origins, (std::vector<std::string>{"https://b.example", "https://c.example"}));
    EXPECT_TRUE(held.insecure);
    EXPECT_EQ(options({}, {{"VSPLITD_CONFIG", file_}}).service.limits.sessions, 11U);
    EXPECT_FALSE(options({"--insecure=false"}, variables).insecure);
}

TEST_F(ServerOptionsTest, RefusesUnknownKeysAndWrongValuesWhereverTheyCome) {
    for (const char* text : {"max-sesions = 11\n", "[limits]\nmax-sessions = 1\n", "max-sessions = many\n", "max-sessions = -1\n",
                             "print-config = true\n", "log-level = loud\n", "drain = 1e99\n", "max-sessions = [1, 2]\n"}) {
        write(text);
        EXPECT_TRUE(refused({"--config", file_})) << text;
    }
    write("max-sesions = 11\n");
    EXPECT_TRUE(refused({"--config", file_}));
    EXPECT_NE(errors_.find("max-sesions"), std::string::npos) << errors_;
    EXPECT_NE(errors_.find("max-sessions"), std::string::npos) << errors_;
    EXPECT_TRUE(refused({"--config", file_ + ".none"}));
    EXPECT_TRUE(refused({}, {{"VSPLITD_MAX_SESSIONS", "many"}}));
    EXPECT_TRUE(refused({"--max-sesions", "3"}));
}

// What strtod and strtoull would take: no number, no decimal, more than there is room for.
TEST_F(ServerOptionsTest, RefusesWhatIsNoNumberOfItsRangeWhereverItComes) {
    struct Wrong {
        const char* option;
        std::vector<const char*> values;
        const char* accepted;
    };
    const std::vector<const char*> fractions{"nan", "-nan", "inf", "-inf", "-1", "1e400", "1e10", "0x10", "many"};
    const std::vector<const char*> wholes{"nan", "inf", "-1", "1.5", "1e3", "0x10", "99999999999999999999999", "many"};
    for (const Wrong& wrong : {
             Wrong{"max-request-rate", fractions, "a number from 0.001 to 1e+09, and 0"},
             Wrong{"slow-job", fractions, "a number from 0 to 1e+09"},
             Wrong{"max-sessions", wholes, "a whole number from 1 to 4294967295"},
             Wrong{"max-waiting", wholes, "a whole number from 0 to 4294967295"},
             Wrong{"max-upload-bytes", wholes, "a whole number from 1 to 18446744073709551615"},
             Wrong{"max-memory-bytes", wholes, "a whole number from 0 to 18446744073709551615"},
             Wrong{"max-disk-bytes", wholes, "a whole number from 0 to 18446744073709551615"},
             Wrong{"max-connections", wholes, "a whole number from 1 to 18446744073709551615"},
             Wrong{"max-message-bytes", wholes, "a whole number from 524288 to 1073741824"},
             Wrong{"session-ttl", wholes, "a whole number from 1 to 3162240000"},
             Wrong{"drain", wholes, "a whole number from 0 to 86400"},
         }) {
        const std::string flag = std::string("--") + wrong.option;
        std::string variable = std::string("VSPLITD_") + wrong.option;
        std::replace(variable.begin(), variable.end(), '-', '_');
        std::transform(variable.begin(), variable.end(), variable.begin(), [](unsigned char c) { return std::toupper(c); });
        for (const char* value : wrong.values) {
            const auto refused_well = [&](const std::vector<std::string>& arguments, const Variables& variables = {}) {
                return refused(arguments, variables) && errors_.find(flag) != std::string::npos &&
                       errors_.find(wrong.accepted) != std::string::npos;
            };
            EXPECT_TRUE(refused_well({std::string(flag).append("=").append(value)})) << flag << ' ' << value << ": " << errors_;
            EXPECT_TRUE(refused_well({}, {{variable, value}})) << variable << ' ' << value << ": " << errors_;
            write(std::string(wrong.option).append(" = ").append(value).append("\n"));
            EXPECT_TRUE(refused_well({"--config", file_})) << "file: " << wrong.option << ' ' << value << ": " << errors_;
        }
    }
    EXPECT_EQ(options({"--max-request-rate", "2.5"}).max_request_rate, 2.5);
    EXPECT_EQ(options({"--max-request-rate", "0"}).max_request_rate, 0);
    for (const char* no_limit : {"1e-300", "0.0009"}) EXPECT_TRUE(refused({"--max-request-rate", no_limit})) << no_limit;
    EXPECT_EQ(options({"--max-upload-bytes=18446744073709551615"}).service.limits.upload_bytes, 18446744073709551615U);
}

TEST_F(ServerOptionsTest, SaysWhereWhatItRefusesCameFrom) {
    const auto why = [this](const std::string& file, const Variables& variables, const std::vector<std::string>& more = {}) {
        write(file);
        std::vector<std::string> arguments{"--config", file_};
        arguments.insert(arguments.end(), more.begin(), more.end());
        EXPECT_TRUE(refused(arguments, variables));
        return errors_.substr(0, errors_.find(';'));
    };
    const std::string from_file = "vsplitd: " + file_ + ": ";
    EXPECT_EQ(why("max-facez = 3\n", {}), from_file + "no option is called 'max-facez'");
    EXPECT_EQ(why("[limits]\nmax-faces = 3\n", {}), from_file + "it has a section [limits], and options are in none");
    EXPECT_EQ(why("max-faces = \"abc\"\n", {}), from_file + "--max-faces: it is \"abc\"");
    EXPECT_EQ(why("", {{"VSPLITD_MAX_FACES", "abc"}}),
              "vsplitd: VSPLITD_MAX_FACES of the environment: --max-faces: it is \"abc\"");
    EXPECT_EQ(why("", {{"VSPLITD_INSECURE", "maybe"}}).find("vsplitd: VSPLITD_INSECURE of the environment: "), 0U) << errors_;
    EXPECT_TRUE(why("", {}, {"--max-faces", "abc"}).starts_with("--max-faces: it is \"abc\"")) << errors_;
    EXPECT_TRUE(why("log-format = \"json\"\nbogus = 1\n", {}).starts_with("{\"time\"")) << errors_;
}

TEST_F(ServerOptionsTest, RefusesAQuotaOfADirectoryThatIsNotThere) {
    EXPECT_TRUE(refused({"--max-disk-bytes", "1000000"}));
    EXPECT_NE(errors_.find("there is no data-dir"), std::string::npos) << errors_;
    EXPECT_EQ(options({"--max-disk-bytes", "1000000", "--data-dir", "d"}).max_disk_bytes, 1'000'000U);
    EXPECT_TRUE(refused({"--max-message-memory-bytes", "5", "--print-config"}));
}

TEST_F(ServerOptionsTest, AnEmptyVariableIsNone) {
    EXPECT_EQ(options({"--drain", "7"}, {{"VSPLITD_DATA_DIR", ""}, {"VSPLITD_MAX_SESSIONS", ""}}).data_dir, "");
}

TEST_F(ServerOptionsTest, PrintsWhatHoldsAsAFileThatSaysTheSame) {
    const std::vector<std::string> asked{"--listen",    "127.0.0.1:7",   "--max-faces",
                                         "77",          "--cors-origin", "https://a.example",
                                         "--log-level", "warning",       "--print-config"};
    const auto parsed = parse(asked, {{"VSPLITD_DRAIN", "9"}});
    ASSERT_TRUE(std::holds_alternative<int>(parsed));
    EXPECT_EQ(std::get<int>(parsed), 0);
    const std::string printed = said_;
    write(printed);
    const ServerOptions again = options({"--config", file_});
    EXPECT_EQ(again.listen, "127.0.0.1:7");
    EXPECT_EQ(again.service.limits.faces, 77U);
    EXPECT_EQ(again.log_level, "warning");
    EXPECT_EQ(again.drain, 9U);
    EXPECT_EQ(again.rest.cors_origins, std::vector<std::string>{"https://a.example"});
    static_cast<void>(parse({"--config", file_, "--print-config"}));
    EXPECT_EQ(said_, printed);
    std::istringstream text(printed);
    EXPECT_TRUE(parse_config(text));
}

TEST_F(ServerOptionsTest, DefaultsAreThoseOfNoOptionAtAll) {
    static_cast<void>(parse({"--print-config"}));
    std::istringstream text(said_);
    const Expected<ServerOptions> read = parse_config(text);
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->listen, ServerOptions().listen);
    EXPECT_EQ(read->rest.cors_origins, ServerOptions().rest.cors_origins);
    EXPECT_EQ(read->tls.cert, "");
    EXPECT_EQ(read->service.session_ttl, ServerOptions().service.session_ttl);
}

TEST(ExposureTest, KnowsThisMachineAlone) {
    for (const char* own : {"127.0.0.1:1", "127.9.9.9:1", "[::1]:1", "localhost:1"})
        EXPECT_TRUE(is_loopback(*parse_listen_address("listen", own))) << own;
    for (const char* open : {"0.0.0.0:1", "[::]:1", "192.168.1.1:1", "[::ffff:10.0.0.1]:1", "no.such.host.invalid:1"})
        EXPECT_FALSE(is_loopback(*parse_listen_address("listen", open))) << open;
}

TEST(ExposureTest, BeyondThisMachineTakesTlsAndTokensOrInsecure) {
    const ListenAddress own{"127.0.0.1", "1"};
    const ListenAddress open{"0.0.0.0", "1"};
    const auto allowed = [&](bool tls, bool tokens, bool insecure, const ListenAddress& grpc, const ListenAddress& http) {
        ServerOptions options;
        if (tls) options.tls = {"cert", "key", ""};
        if (tokens) options.token_file = "tokens";
        options.insecure = insecure;
        return check_exposure(options, grpc, http).has_value();
    };
    for (const bool tls : {false, true}) {
        for (const bool tokens : {false, true}) {
            EXPECT_TRUE(allowed(tls, tokens, false, own, own));
            EXPECT_EQ(allowed(tls, tokens, false, open, own), tls && tokens);
            EXPECT_EQ(allowed(tls, tokens, false, own, open), tls && tokens);
            EXPECT_TRUE(allowed(tls, tokens, true, open, open));
        }
    }
    ServerOptions half;
    half.tls.cert = "cert";
    EXPECT_FALSE(check_exposure(half, own, own));
}

TEST(NewTokenTest, MakesAnotherEachTimeWithItsLine) {
    const auto first = make_token("ann:read-write");
    const auto second = make_token("ann:read-only");
    ASSERT_TRUE(first && second);
    EXPECT_GE(first->token.size(), guard::kShortestToken);
    EXPECT_NE(first->token, second->token);
    const auto read = guard::parse_token_file(first->line, "tokens");
    ASSERT_TRUE(read);
    EXPECT_EQ(read->front().digest, guard::digest_of(first->token));
    EXPECT_EQ(read->front().access, guard::Access::kWrite);
    for (const char* wrong : {"", "ann", "ann:", ":read-only", "ann:write", "a b:read-only"})
        EXPECT_FALSE(make_token(wrong)) << wrong;
}

}  // namespace
}  // namespace vsplit::ops

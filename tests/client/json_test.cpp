#include "wire/json.h"

#include <google/protobuf/util/message_differencer.h>
#include <gtest/gtest.h>

#include "vsplit/v1/meshing.pb.h"

namespace vsplit::wire {
namespace {

TEST(JsonTest, WritesDefaultsAndCamelCase) {
    v1::Representation representation;
    representation.set_method(v1::IMPROVE);
    const std::string text = to_json(representation);
    EXPECT_NE(text.find("\"method\":\"IMPROVE\""), std::string::npos) << text;
    EXPECT_NE(text.find("\"facesMin\":0"), std::string::npos) << text;
    EXPECT_NE(text.find("\"boundsSatisfied\":false"), std::string::npos) << text;
    EXPECT_NE(text.find("\"violations\":[]"), std::string::npos) << text;
}

TEST(JsonTest, LeavesAbsentOptionsOut) {
    v1::ControlOptions options;
    options.set_tolerance(0.5);
    const std::string text = to_json(options);
    EXPECT_NE(text.find("\"tolerance\":0.5"), std::string::npos) << text;
    EXPECT_EQ(text.find("maxSize"), std::string::npos) << text;
}

TEST(JsonTest, ReadsBackWhatItWrote) {
    v1::Representation written;
    written.set_id("abc");
    written.mutable_improve_options()->set_tolerance(1.0 / 3);
    written.mutable_elapsed()->set_seconds(3);
    written.mutable_elapsed()->set_nanos(250'000'000);
    for (const JsonStyle style : {JsonStyle::kLine, JsonStyle::kIndented}) {
        v1::Representation read;
        ASSERT_TRUE(from_json(to_json(written, style), read));
        EXPECT_TRUE(google::protobuf::util::MessageDifferencer::Equals(written, read));
    }
}

TEST(JsonTest, RefusesWhatIsNoJsonOfTheMessage) {
    v1::Representation message;
    for (const char* text : {"", "{", "[]", "7", "\xff", "[1,2]", "null", "{}{}", "{'faces': 1}"}) {
        const Status read = from_json(text, message);
        ASSERT_FALSE(read) << text;
        EXPECT_EQ(read.error().cause, Cause::kMalformedInput);
        EXPECT_NE(read.error().message.find("Representation"), std::string::npos);
    }
    EXPECT_TRUE(from_json("{\"noSuchField\": 1}", message, UnknownFields::kIgnored));
}

Error refusal_of(const std::string& text) {
    v1::ImproveRequest message;
    const Status read = from_json(text, message);
    EXPECT_FALSE(read) << text;
    return read ? Error{} : read.error();
}

TEST(JsonTest, NamesTheFieldThatDoesNotTakeItsValue) {
    const auto expect = [](const std::string& text, const std::string& field, const std::string& message) {
        const Error error = refusal_of(text);
        EXPECT_EQ(error.cause, Cause::kInvalidOption) << text;
        EXPECT_EQ(error.field, field) << text;
        EXPECT_EQ(error.message, field + " is " + message);
    };
    const std::string whole = "; accepted is a whole number from 0 to 4294967295";
    for (const std::string value : {"1.5", "-5", "1e+30", "\"abc\"", "\"\"", "true", "4294967296"}) {
        expect(R"({"options": {"faces": )" + value + "}}", "options.faces", value + whole);
    }
    expect(R"({"options": {"faces_min": {}}})", "options.facesMin", "an object" + whole);
    expect(R"({"options": {"faces": [1]}})", "options.faces", "a list" + whole);
    expect(R"({"options": {"markedEdges": [1, 2.5]}})", "options.markedEdges[1]", "2.5" + whole);
    expect(R"({"options": {"sizing": {"spheres": [{}, {"size": "x"}]}}})", "options.sizing.spheres[1].size",
           "\"x\"; accepted is a number");
    expect(R"({"options": {"mode": "fast"}})", "options.mode", "\"fast\"; accepted is one of MODE_UNSPECIFIED, STRICT, EXTENDED");
    expect(R"({"options": {"freezeBoundary": 1}})", "options.freezeBoundary", "1; accepted is true or false");
    expect(R"({"options": 5})", "options", "5; accepted is an object; a query names its fields with a dot");
    expect(R"({"session": 5})", "session", "5; accepted is text");
}

// Words of protobuf's or nlohmann's parser would say nothing to who writes JSON.
TEST(JsonTest, SaysInItsOwnWordsWhatIsWrongAndWhere) {
    struct Wrong {
        const char* text;
        Cause cause;
        const char* message;
    };
    constexpr const char* kJson = "; accepted is JSON as RFC 8259 has it, in UTF-8";
    const auto broken = [&](const std::string& what) { return "not the JSON of a vsplit.v1.ImproveRequest: " + what; };
    const std::string fields = "; accepted is an object with session, source, options, encoding, quantisationBits";
    const auto expect = [](const std::string& text, Cause cause, const std::string& message) {
        const Error error = refusal_of(text);
        EXPECT_EQ(error.cause, cause) << text;
        EXPECT_EQ(error.message, message);
    };
    expect("[1,2]", Cause::kMalformedInput, broken("it is a list" + fields));
    expect("7", Cause::kMalformedInput, broken("it is 7" + fields));
    expect("", Cause::kMalformedInput, broken(std::string("it ends after byte 0, where more is due") + kJson));
    expect(R"({"options": {"faces": )", Cause::kMalformedInput,
           broken(std::string("it ends after byte 22, in options.faces, where more is due") + kJson));
    expect(R"({"options": {"markedEdges": [1, x]}})", Cause::kMalformedInput,
           broken(std::string("at byte 33, in options.markedEdges[0] it breaks off with \"1, x\"") + kJson));
    expect(R"({"options": {"tolerance": 1e400}})", Cause::kInvalidOption,
           "options.tolerance is 1e400; accepted is a number up to 1.8e308");
    expect(R"({"options": {"tolerance": "1e400"}})", Cause::kInvalidOption,
           "options.tolerance is \"1e400\"; accepted is a number");
    expect(R"({"session": "a", "session": "b"})", Cause::kInvalidOption, "session is there twice; accepted is once");
    expect(R"({"options": {"facesMin": 4, "faces_min": 5}})", Cause::kInvalidOption,
           "options.facesMin is there twice; accepted is once");
    expect(R"({"options": {"markedEdges": 1}})", Cause::kInvalidOption,
           "options.markedEdges is 1; accepted is a list, each element a whole number from 0 to 4294967295");
    expect(R"({"options": {"freezeBoundary": "true"}})", Cause::kInvalidOption,
           "options.freezeBoundary is \"true\"; accepted is true or false");
    std::string deep;
    for (int i = 0; i < 100; ++i) deep += "[";
    EXPECT_NE(refusal_of(R"({"options": {"regions": )" + deep).message, "");
    v1::ProgressiveEvent event;
    const Status two = from_json(R"({"progress": {}, "error": {}})", event);
    ASSERT_FALSE(two);
    EXPECT_EQ(two.error().message, "error and progress exclude each other; accepted is one of them");
    EXPECT_EQ(two.error().field, "error");
}

TEST(JsonTest, TakesEnumsByAnyOfTheirNames) {
    v1::DownloadMeshRequest download;
    ASSERT_TRUE(from_json(R"({"session": "the \"mm\" one", "unit": "mm", "format": "3MF"})", download));
    EXPECT_EQ(download.session(), "the \"mm\" one");
    EXPECT_EQ(download.unit(), v1::MILLIMETRE);
    EXPECT_EQ(download.format(), v1::THREE_MF);
    ASSERT_TRUE(from_json(R"({"format":"stl-ascii","unit":"INCH"})", download));
    EXPECT_EQ(download.format(), v1::STL_ASCII);
    EXPECT_EQ(download.unit(), v1::INCH);
    ASSERT_TRUE(from_json(R"({"format": "ply_ASCII", "unit" : "\u0066t" })", download)) << "escaped";
    EXPECT_EQ(download.format(), v1::PLY_ASCII);
    EXPECT_EQ(download.unit(), v1::FOOT);
    v1::RemoveFeaturesRequest removal;
    ASSERT_TRUE(from_json(R"({"kinds": ["boss", 4, "through-hole", "FILLET"], "ids": [1, 2]})", removal));
    ASSERT_EQ(removal.kinds_size(), 4);
    EXPECT_EQ(removal.kinds(0), v1::ShapeFeature::BOSS);
    EXPECT_EQ(removal.kinds(2), v1::ShapeFeature::THROUGH_HOLE);
    EXPECT_EQ(removal.ids_size(), 2);
    const Status yard = from_json(R"({"unit": "yd"})", download);
    ASSERT_FALSE(yard);
    EXPECT_NE(yard.error().message.find("MILLIMETRE (mm)"), std::string::npos) << yard.error().message;
}

TEST(JsonTest, SaysWhereATextIsRespelled) {
    const auto size = [](const char* text) {
        return check_json(text, *v1::CreateSessionRequest::descriptor(), UnknownFields::kRefused);
    };
    EXPECT_TRUE(size(R"({"unit": "mm"})")->respelled);
    EXPECT_FALSE(size(R"({"unit": "MILLIMETRE", "format": 3, "repair": "2"})")->respelled);
}

TEST(JsonTest, TakesWhatProto3JsonTakes) {
    v1::ImproveRequest request;
    for (const char* text :
         {"{}", "{\"session\": null}", R"({"options": {"faces": "5", "tolerance": "0.5"}})", R"({"options": {"faces": 5.0}})",
          R"({"options": {"faces": 5e2, "tolerance": "Infinity", "minStretch": "NaN"}})", R"({"options": {"mode": 1}})",
          R"({"options": {"mode": "1", "regions": [], "markedEdges": [1, "2", 3.0]}})",
          R"({"options": {"sizing": {"boxes": [{}, {"min": {"x": -1e308}}]}}})", R"({"options": null})"}) {
        const Status read = from_json(text, request);
        EXPECT_TRUE(read) << text << ": " << (read ? "" : read.error().message);
    }
    v1::CreateSessionRequest create;
    EXPECT_TRUE(from_json(R"({"mesh": "YWJj"})", create));
    EXPECT_TRUE(from_json(R"({"mesh": "YWI"})", create));
    EXPECT_FALSE(from_json(R"({"mesh": "Y"})", create));
    EXPECT_FALSE(from_json(R"({"mesh": "Y*=="})", create));
}

TEST(JsonTest, SaysHowMuchItWouldMakeBeforeItDoes) {
    v1::ImproveRequest request;
    const auto admit = [](const JsonSize& size) -> Status {
        EXPECT_EQ(size.messages, 5U);
        EXPECT_EQ(size.values, 3U);
        return Error{Cause::kLimitExceeded, "no", ""};
    };
    const Status refused = from_json(R"({"options": {"faces": 7, "sizing": {"boxes": [{"size": 1}, {}]}}})", request,
                                     UnknownFields::kRefused, admit);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().cause, Cause::kLimitExceeded);
    EXPECT_FALSE(request.has_options()) << "nothing was made";
}

TEST(JsonTest, NamesTheFieldThatThereIsNot) {
    const Error error = refusal_of(R"({"options": {"faecs": 1}})");
    EXPECT_EQ(error.cause, Cause::kInvalidOption);
    EXPECT_EQ(error.field, "options.faecs");
    EXPECT_NE(error.message.find("ImproveOptions has no field"), std::string::npos) << error.message;
    EXPECT_NE(error.message.find("facesMin"), std::string::npos) << error.message;
    EXPECT_EQ(refusal_of(R"({"options.faces": 1})").field, "options.faces");
    // Names that look like what the parser says.
    for (const char* name :
         {"(options.faces): invalid value 1 for type x", "): invalid value  for type ", "(", "()", "(options) a"}) {
        EXPECT_NE(refusal_of(std::string("{\"") + name + "\": 1}").message, "") << name;
    }
}

TEST(JsonTest, SurvivesDeepNesting) {
    v1::Representation message;
    EXPECT_FALSE(from_json(std::string(100'000, '['), message));
    EXPECT_FALSE(from_json("{\"x\":" + std::string(100'000, '['), message, UnknownFields::kIgnored));
}

}  // namespace
}  // namespace vsplit::wire

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
    for (const char* text : {"", "{", "[]", "{\"faces\": -1}", "{\"faces\": \"many\"}", "{\"noSuchField\": 1}", "\xff"}) {
        const Status read = from_json(text, message);
        ASSERT_FALSE(read) << text;
        EXPECT_EQ(read.error().cause, Cause::kMalformedInput);
        EXPECT_NE(read.error().message.find("Representation"), std::string::npos);
    }
    EXPECT_TRUE(from_json("{\"noSuchField\": 1}", message, UnknownFields::kIgnored));
}

TEST(JsonTest, SurvivesDeepNesting) {
    v1::Representation message;
    EXPECT_FALSE(from_json(std::string(100'000, '['), message));
    EXPECT_FALSE(from_json("{\"x\":" + std::string(100'000, '['), message, UnknownFields::kIgnored));
}

}  // namespace
}  // namespace vsplit::wire

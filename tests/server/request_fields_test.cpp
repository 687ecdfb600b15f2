#include "rest/request_fields.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "vsplit/v1/meshing.pb.h"

namespace vsplit::rest {
namespace {

TEST(RequestFieldsTest, SetsFieldsByBothNames) {
    v1::ImproveRequest request;
    EXPECT_TRUE(set_field(request, "session", "abc"));
    EXPECT_TRUE(set_field(request, "options.maxDeviation", "0.5"));
    EXPECT_TRUE(set_field(request, "options.feature_angle", "30"));
    EXPECT_TRUE(set_field(request, "options.mode", "strict"));
    EXPECT_TRUE(set_field(request, "options.freezeBoundary", "true"));
    EXPECT_TRUE(set_field(request, "options.regions", "1"));
    EXPECT_TRUE(set_field(request, "options.regions", "2"));
    EXPECT_EQ(request.session(), "abc");
    EXPECT_EQ(request.options().max_deviation(), 0.5);
    EXPECT_EQ(request.options().feature_angle(), 30);
    EXPECT_EQ(request.options().mode(), v1::STRICT);
    EXPECT_TRUE(request.options().freeze_boundary());
    EXPECT_EQ(request.options().regions_size(), 2);
}

TEST(RequestFieldsTest, EnumsAndWellKnownTypes) {
    v1::DownloadMeshRequest download;
    EXPECT_TRUE(set_field(download, "format", "stl-ascii"));
    EXPECT_EQ(download.format(), v1::STL_ASCII);
    download.clear_format();
    EXPECT_TRUE(set_field(download, "format", "3"));
    EXPECT_EQ(download.format(), v1::OBJ);
    download.clear_format();
    EXPECT_TRUE(set_field(download, "format", "3mf"));
    EXPECT_TRUE(set_field(download, "format", "three-MF")) << "the same";
    EXPECT_EQ(download.format(), v1::THREE_MF);
    EXPECT_TRUE(set_field(download, "unit", "Mm"));
    EXPECT_EQ(download.unit(), v1::MILLIMETRE);
    EXPECT_THAT(set_field(download, "unit", "yd").error().message, ::testing::HasSubstr("MILLIMETRE (mm)"));
    v1::Representation representation;
    EXPECT_TRUE(set_field(representation, "elapsed", "1.5s"));
    EXPECT_EQ(representation.elapsed().seconds(), 1);
    EXPECT_FALSE(set_field(representation, "elapsed", "\"}"));
}

TEST(RequestFieldsTest, TwoValuesOfAFieldMustAgree) {
    v1::ImproveRequest request;
    const auto expect = [&](const char* name, const char* one, const char* other) {
        EXPECT_TRUE(set_field(request, name, one)) << name;
        EXPECT_TRUE(set_field(request, name, one)) << name << " twice the same";
        const Status refused = set_field(request, name, other);
        ASSERT_FALSE(refused) << name;
        EXPECT_EQ(refused.error().field, name);
        EXPECT_THAT(refused.error().message, ::testing::HasSubstr(other));
    };
    expect("session", "a", "b");
    expect("options.faces", "8", "0");
    expect("options.tolerance", "0.5", "0.25");
    expect("options.mode", "strict", "extended");
    expect("options.freezeBoundary", "true", "false");
}

TEST(RequestFieldsTest, SaysWhatIsWrongAndWhatWouldDo) {
    v1::GetQualityRequest request;
    const Status unknown = set_field(request, "wrost", "1");
    ASSERT_FALSE(unknown);
    EXPECT_EQ(unknown.error().cause, Cause::kInvalidOption);
    EXPECT_EQ(unknown.error().field, "wrost");
    EXPECT_THAT(unknown.error().message, ::testing::HasSubstr("worst"));
    for (const char* text : {"", "-1", "1.5", "1x", "4294967296", " 1"}) EXPECT_FALSE(set_field(request, "worst", text)) << text;
    EXPECT_FALSE(set_field(request, "worst.more", "1"));
    EXPECT_FALSE(set_field(request, "", "1"));
    v1::CreateSessionRequest create;
    EXPECT_FALSE(set_field(create, "mesh", "abc")) << "bytes";
    EXPECT_THAT(set_field(create, "format", "tiff").error().message, ::testing::HasSubstr("STL_ASCII"));
}

}  // namespace
}  // namespace vsplit::rest

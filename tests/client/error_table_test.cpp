#include "wire/error_table.h"

#include <gtest/gtest.h>

#include <string>

#include "google/rpc/error_details.pb.h"
#include "google/rpc/status.pb.h"

namespace vsplit::wire {
namespace {

TEST(ErrorTableTest, EveryCauseSurvivesTheWayThroughAStatus) {
    for (const ErrorRow& row : error_table()) {
        const Error error{row.cause, "what was wrong, and where", "max_size"};
        const grpc::Status status = to_status(error);
        EXPECT_EQ(status.error_code(), row.grpc_code);
        const Error restored = from_status(status);
        EXPECT_EQ(restored.cause, error.cause) << cause_name(error.cause);
        EXPECT_EQ(restored.message, error.message);
        EXPECT_EQ(restored.field, error.field);
    }
}

TEST(ErrorTableTest, WhenToTryAgainTravelsAndChangesTheHttpStatus) {
    const Error later{Cause::kLimitExceeded, "too many sessions", "", 7};
    EXPECT_EQ(from_status(to_status(later)).retry_after, 7U);
    EXPECT_EQ(http_status(later), 429);
    const Error never{Cause::kLimitExceeded, "too many faces", "faces"};
    EXPECT_EQ(from_status(to_status(never)).retry_after, 0U);
    EXPECT_EQ(http_status(never), 413);
    EXPECT_EQ(http_status({Cause::kBusy, "at work", "", 7}), 409);
}

TEST(ErrorTableTest, NamesAreInverted) {
    for (const ErrorRow& row : error_table()) EXPECT_EQ(cause_by_name(cause_name(row.cause)), row.cause);
    EXPECT_EQ(cause_by_name("NO_SUCH_CAUSE"), std::nullopt);
}

TEST(ErrorTableTest, HttpStatusesAreThoseOfErrors) {
    for (const ErrorRow& row : error_table()) {
        EXPECT_GE(row.http_status, 400);
        EXPECT_LT(row.http_status, 600);
        EXPECT_NE(row.grpc_code, grpc::StatusCode::OK);
    }
    EXPECT_EQ(error_row(Cause::kNotFound).http_status, 404);
    EXPECT_EQ(error_row(Cause::kInvalidOption).http_status, 400);
}

TEST(ErrorTableTest, DetailsAreThoseOfTheContract) {
    const grpc::Status status = to_status({Cause::kNonManifold, "edge 1-2 has 3 faces", ""});
    google::rpc::Status details;
    ASSERT_TRUE(details.ParseFromString(status.error_details()));
    EXPECT_EQ(details.code(), status.error_code());
    EXPECT_EQ(details.message(), "edge 1-2 has 3 faces");
    google::rpc::ErrorInfo info;
    ASSERT_EQ(details.details_size(), 1);
    ASSERT_TRUE(details.details(0).UnpackTo(&info));
    EXPECT_EQ(info.reason(), "NON_MANIFOLD");
    EXPECT_EQ(info.domain(), "vsplit");
    EXPECT_EQ(info.metadata().count("field"), 0U);
}

TEST(ErrorTableTest, LongAndBrokenMessagesFitTheTrailers) {
    const grpc::Status status = to_status({Cause::kMalformedInput, std::string(100'000, '\xff'), std::string(5000, 'f')});
    EXPECT_LE(status.error_message().size(), kMaxMessageBytes);
    EXPECT_LT(status.error_message().size() * 3 + status.error_details().size() * 4 / 3, 8192U);
    EXPECT_EQ(from_status(status).cause, Cause::kMalformedInput);
}

TEST(ErrorTableTest, StatusesWithoutDetailsGetTheCauseTheirCodeSuggests) {
    EXPECT_EQ(from_status({grpc::StatusCode::UNAVAILABLE, "gone"}).cause, Cause::kUnavailable);
    EXPECT_EQ(from_status({grpc::StatusCode::CANCELLED, ""}).cause, Cause::kCancelled);
    EXPECT_EQ(from_status({grpc::StatusCode::DEADLINE_EXCEEDED, ""}).cause, Cause::kDeadlineExceeded);
    EXPECT_EQ(from_status({grpc::StatusCode::RESOURCE_EXHAUSTED, ""}).cause, Cause::kLimitExceeded);
    EXPECT_EQ(from_status({grpc::StatusCode::UNKNOWN, "?"}).cause, Cause::kInternal);
    EXPECT_EQ(from_status({grpc::StatusCode::UNAVAILABLE, "gone"}).message, "gone");
}

TEST(ErrorTableTest, DetailsOfOthersAreNotTrusted) {
    google::rpc::ErrorInfo info;
    info.set_reason("NON_MANIFOLD");
    info.set_domain("elsewhere");
    google::rpc::Status details;
    details.add_details()->PackFrom(info);
    EXPECT_EQ(from_status({grpc::StatusCode::NOT_FOUND, "x", details.SerializeAsString()}).cause, Cause::kNotFound);
    EXPECT_EQ(from_status({grpc::StatusCode::NOT_FOUND, "x", "\xff garbage"}).cause, Cause::kNotFound);
}

}  // namespace
}  // namespace vsplit::wire

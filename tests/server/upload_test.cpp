#include "service/upload.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "tests/core/meshes.h"
#include "vsplit/io/write_mesh.h"

namespace vsplit::service {
namespace {

using ::testing::HasSubstr;

std::span<const std::byte> bytes_of(std::string_view text) { return std::as_bytes(std::span(text)); }

bool always() { return true; }

class UploadTest : public ::testing::Test {
protected:
    Expected<Upload> begin(std::optional<std::uint64_t> size = std::nullopt) {
        return Upload::begin(session_, {{}, size}, options_, memory_, disk_);
    }

    // The session is as it was before any upload.
    bool unharmed() const { return session_->snapshot().source == nullptr && session_->require_idle(); }

    ServiceOptions options_;
    MemoryBudget memory_{0};
    SessionArchive archive_;
    UploadRoom disk_{archive_, 1000};
    WorkerPool workers_{1};
    std::shared_ptr<Session> session_ =
        std::make_shared<Session>(SessionRecord{.number = 1, .id = "id", .expires = std::chrono::hours(1)}, Session::Clock::now(),
                                  SessionHost{options_, memory_, archive_, workers_});
    const std::string file_ = write_mesh(test::cube(), MeshFormat::kOff);
};

TEST_F(UploadTest, PutsTheMeshIntoTheSession) {
    Expected<Upload> upload = begin(file_.size());
    ASSERT_TRUE(upload);
    for (std::size_t at = 0; at < file_.size(); at += 7) ASSERT_TRUE(upload->append(at, bytes_of(file_.substr(at, 7))));
    EXPECT_TRUE(unharmed()) << "nothing changes before the commit";
    const Expected<SessionSnapshot> session = upload->commit(always);
    ASSERT_TRUE(session) << session.error().message;
    EXPECT_EQ(**session->source->mesh->get(), test::cube());
    EXPECT_TRUE(session->source->report.closed);
}

TEST_F(UploadTest, AClientThatLeavesEndsTheRepair) {
    UploadSettings settings;
    settings.mesh.repair = RepairOptions{.mode = RepairMode::kFull};
    const auto commit_asked = [&](int times) {
        Expected<Upload> upload = Upload::begin(session_, settings, options_, memory_, disk_);
        EXPECT_TRUE(upload && upload->append(0, bytes_of(file_)));
        std::atomic<int> left = times;
        return upload->commit([&] { return left-- > 0; });
    };
    for (int times = 0; times < 5; ++times) {
        const Expected<SessionSnapshot> session = commit_asked(times);
        ASSERT_FALSE(session) << times;
        EXPECT_EQ(session.error().cause, Cause::kCancelled);
        EXPECT_TRUE(unharmed());
    }
    EXPECT_TRUE(commit_asked(1'000'000));
}

TEST_F(UploadTest, RepairIsWorkWhoseTimeEnds) {
    options_.limits.job_seconds = 0;
    UploadSettings settings;
    settings.mesh.repair = RepairOptions{.mode = RepairMode::kFull};
    Expected<Upload> upload = Upload::begin(session_, settings, options_, memory_, disk_);
    ASSERT_TRUE(upload && upload->append(0, bytes_of(file_)));
    const Expected<SessionSnapshot> session = upload->commit(always);
    ASSERT_FALSE(session);
    EXPECT_THAT(session.error().message, HasSubstr("max_job_seconds"));
    EXPECT_TRUE(unharmed());
}

TEST_F(UploadTest, UploadsOnTheirWayTakeDiskTogether) {
    const std::string part(400, ' ');
    {
        Expected<Upload> first = begin(), second = begin();
        ASSERT_TRUE(first && second);
        ASSERT_TRUE(first->append(0, bytes_of(part)));
        ASSERT_TRUE(second->append(0, bytes_of(part)));
        const Status refused = first->append(400, bytes_of(part));
        ASSERT_FALSE(refused);
        EXPECT_EQ(refused.error().cause, Cause::kLimitExceeded);
        EXPECT_THAT(refused.error().message, HasSubstr("max_disk_bytes, 1000"));
    }
    Expected<Upload> next = begin();
    ASSERT_TRUE(next);
    EXPECT_TRUE(next->append(0, bytes_of(std::string(1000, ' ')))) << "what has ended takes none";
}

TEST_F(UploadTest, RefusesADeclaredSizeOverTheLimitBeforeAnyByte) {
    options_.limits.upload_bytes = 100;
    const Expected<Upload> upload = begin(101);
    ASSERT_FALSE(upload);
    EXPECT_EQ(upload.error().cause, Cause::kLimitExceeded);
    EXPECT_EQ(upload.error().field, "size");
    EXPECT_THAT(upload.error().message, HasSubstr("max_upload_bytes is 100"));
}

TEST_F(UploadTest, RefusesBytesOverTheLimitAsTheyCome) {
    options_.limits.upload_bytes = 100;
    Expected<Upload> upload = begin();
    ASSERT_TRUE(upload);
    ASSERT_TRUE(upload->append(0, bytes_of(std::string(100, 'x'))));
    const Status over = upload->append(100, bytes_of("x"));
    ASSERT_FALSE(over);
    EXPECT_EQ(over.error().cause, Cause::kLimitExceeded);
}

TEST_F(UploadTest, NamesTheOffsetItExpected) {
    Expected<Upload> upload = begin();
    ASSERT_TRUE(upload && upload->append(0, bytes_of("0123456789")));
    const Status gap = upload->append(20, bytes_of("x"));
    ASSERT_FALSE(gap);
    EXPECT_EQ(gap.error().cause, Cause::kOutOfOrder);
    EXPECT_EQ(gap.error().field, "offset");
    EXPECT_THAT(gap.error().message, HasSubstr("offset is 20, expected is 10"));
}

TEST_F(UploadTest, RefusesMoreAndLessThanWasDeclared) {
    Expected<Upload> more = begin(5);
    ASSERT_TRUE(more);
    EXPECT_EQ(more->append(0, bytes_of("123456")).error().cause, Cause::kMalformedInput);
    Expected<Upload> less = begin(file_.size() + 1);
    ASSERT_TRUE(less && less->append(0, bytes_of(file_)));
    const Expected<SessionSnapshot> cut_off = less->commit(always);
    ASSERT_FALSE(cut_off);
    EXPECT_EQ(cut_off.error().cause, Cause::kTruncatedInput);
    EXPECT_TRUE(unharmed());
}

TEST_F(UploadTest, ChangesNothingWhenItIsNotWantedAnyMore) {
    Expected<Upload> upload = begin();
    ASSERT_TRUE(upload && upload->append(0, bytes_of(file_)));
    const Expected<SessionSnapshot> unwanted = upload->commit([] { return false; });
    ASSERT_FALSE(unwanted);
    EXPECT_EQ(unwanted.error().cause, Cause::kCancelled);
    EXPECT_TRUE(unharmed());
}

TEST_F(UploadTest, RefusesAWeldThatIsNoLengthBeforeAnyByte) {
    for (const double weld : {-1.0, std::nan(""), HUGE_VAL}) {
        const Expected<Upload> upload = Upload::begin(session_, {{std::nullopt, weld}, std::nullopt}, options_, memory_, disk_);
        ASSERT_FALSE(upload) << weld;
        EXPECT_EQ(upload.error().cause, Cause::kInvalidOption);
        EXPECT_EQ(upload.error().field, "weld");
    }
}

TEST_F(UploadTest, NamesTheLimitOfFaces) {
    options_.limits.faces = 11;
    Expected<Upload> upload = begin();
    ASSERT_TRUE(upload && upload->append(0, bytes_of(file_)));
    const Expected<SessionSnapshot> session = upload->commit(always);
    ASSERT_FALSE(session);
    EXPECT_EQ(session.error().cause, Cause::kLimitExceeded);
    EXPECT_THAT(session.error().message, HasSubstr("11"));
    EXPECT_TRUE(unharmed());
}

TEST_F(UploadTest, AnOpenMeshIsAccepted) {
    TriangleMesh open = test::cube();
    open.faces.pop_back();
    Expected<Upload> upload = begin();
    ASSERT_TRUE(upload && upload->append(0, bytes_of(write_mesh(open, MeshFormat::kOff))));
    const Expected<SessionSnapshot> session = upload->commit(always);
    ASSERT_TRUE(session);
    EXPECT_FALSE(session->source->report.closed);
    EXPECT_EQ(session->source->report.boundary_edges, 3U);
}

}  // namespace
}  // namespace vsplit::service

#include "store/stored_sessions.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <variant>
#include <vector>

#include "service/session_store.h"
#include "store/data_dir.h"
#include "store/sqlite.h"
#include "store/sqlite_session_index.h"
#include "tests/core/meshes.h"
#include "tests/temp_directory.h"
#include "vsplit/method/control.h"
#include "vsplit/method/improve.h"

namespace vsplit::store {
namespace {

using service::MethodRequest;
using service::SessionSnapshot;
using std::chrono::milliseconds;
using ::testing::HasSubstr;

/// A store on a data directory, as a server has it from its start to its end. What it holds may outlive it, but not `budget`.
struct ServerRun {
    explicit ServerRun(const std::filesystem::path& directory, service::MemoryBudget& budget, std::uint64_t quota = 0)
        : data(*DataDir::open(directory, quota, [this](const std::string& message) { told += message + '\n'; })),
          archive(data.take_archive()),
          memory(budget) {
        const Status restored = store.restore();
        EXPECT_TRUE(restored) << restored.error().message;
    }

    std::shared_ptr<const service::SourceMesh> source_of(const TriangleMesh& mesh, std::optional<LengthUnit> unit = {}) {
        MeshReport report = inspect(mesh);
        report.unit = unit;
        return service::make_source(mesh, std::move(report), memory);
    }

    std::string told;
    service::ServiceOptions options;
    DataDir data;
    std::unique_ptr<service::SessionArchive> archive;
    service::MemoryBudget& memory;
    service::WorkerPool workers{1};
    service::SessionStore store{service::SessionHost{options, memory, *archive, workers}};
};

MethodResult improved(const TriangleMesh& mesh, const ImproveOptions& options) {
    auto result = improve(mesh, options, {}, ExecutionContext());
    EXPECT_TRUE(result) << result.error().message;
    return *std::move(result);
}

MethodResult controlled(const TriangleMesh& mesh, const ControlOptions& options) {
    auto result = control(mesh, options, {}, ExecutionContext());
    EXPECT_TRUE(result) << result.error().message;
    return *std::move(result);
}

void expect_same(const Quality& a, const Quality& b) {
    EXPECT_EQ(a.faces, b.faces);
    EXPECT_EQ(a.stretch_min, b.stretch_min);
    EXPECT_EQ(a.stretch_mean, b.stretch_mean);
    EXPECT_EQ(a.stretch_p01, b.stretch_p01);
    EXPECT_EQ(a.stretch_histogram, b.stretch_histogram);
    EXPECT_EQ(a.deviation_max, b.deviation_max);
    EXPECT_EQ(a.crease_deviation_max, b.crease_deviation_max);
}

/// What is as large as the mesh is not told of a representation, so it need not be kept.
MethodOptions without_arrays(MethodOptions options) {
    std::visit([](auto& o) { o.regions.clear(); }, options);
    return options;
}

void expect_same(const service::Representation& a, const service::Representation& b) {
    EXPECT_EQ(a.id(), b.id());
    EXPECT_EQ(a.asked(), b.asked());
    EXPECT_EQ(a.extent(), b.extent());
    EXPECT_EQ(a.figures().faces, b.figures().faces);
    EXPECT_EQ(a.figures().faces_subdivided, b.figures().faces_subdivided);
    EXPECT_EQ(without_arrays(a.figures().options), without_arrays(b.figures().options));
    EXPECT_EQ(a.figures().violations.size(), b.figures().violations.size());
    EXPECT_EQ(a.figures().slivers.size(), b.figures().slivers.size());
    expect_same(a.figures().quality, b.figures().quality);
    EXPECT_EQ((*a.levels().get())->mrr(), (*b.levels().get())->mrr());
}

class StoredSessionsTest : public ::testing::Test {
protected:
    std::vector<std::filesystem::path> blobs() const {
        std::vector<std::filesystem::path> files;
        for (const auto& entry : std::filesystem::recursive_directory_iterator(scratch_.path() / "blobs")) {
            if (entry.is_regular_file()) files.push_back(entry.path());
        }
        return files;
    }

    test::TempDirectory scratch_;
    service::MemoryBudget memory_{0};
};

TEST_F(StoredSessionsTest, ASessionIsTheSameAfterARestart) {
    TriangleMesh mesh = test::plate_with_holes(3);
    for (std::uint32_t face = 0; face < mesh.face_count(); ++face) mesh.regions.push_back(face % 2);
    mesh.sets = {{"left", {0}}, {"caf\xe9, which is no UTF-8", {0, 1}}};
    const ImproveOptions improving{.faces = 400, .sizing = SizingOptions{.spheres = {{Vec3(1, 2, 3), 4, 5}}}};
    const ControlOptions controlling{.min_stretch = 0.999, .max_valence = 7, .marked_edges = {0, 1}};
    std::optional<SessionSnapshot> before;
    {
        ServerRun run(scratch_.path(), memory_);
        const auto session = *run.store.create(run.source_of(mesh, LengthUnit::kInch), "somebody");
        MethodResult first = improved(mesh, {.faces = 400});
        first.unit = LengthUnit::kInch;
        ASSERT_TRUE(session->add_representation({{"", mesh.face_count()}, improving}, std::move(first)));
        MethodResult second = controlled(mesh, {.min_stretch = 0.999, .max_valence = 7});
        EXPECT_FALSE(second.violations.empty());
        ASSERT_TRUE(session->add_representation({{"r1", 400}, controlling}, std::move(second)));
        ASSERT_TRUE(run.store.create(nullptr));
        before = session->snapshot();
    }
    ServerRun run(scratch_.path(), memory_);
    EXPECT_EQ(run.told, "");
    EXPECT_EQ(run.store.count(), 2U);
    EXPECT_FALSE(run.store.find(before->id)) << "it is somebody's";
    const auto session = run.store.find(before->id, "somebody");
    ASSERT_TRUE(session);
    const SessionSnapshot after = (*session)->snapshot();
    EXPECT_EQ(after.create_time, before->create_time);
    EXPECT_EQ(**after.source->mesh->get(), mesh);
    EXPECT_EQ(after.source->report.unit, LengthUnit::kInch);
    EXPECT_EQ(after.representations.at(0)->figures().unit, LengthUnit::kInch);
    EXPECT_EQ(after.representations.at(1)->figures().unit, std::nullopt);
    EXPECT_EQ(after.source->report.closed, before->source->report.closed);
    EXPECT_EQ(after.source->report.genus, before->source->report.genus);
    EXPECT_EQ(after.source->report.groups.count, 2U);
    ASSERT_EQ(after.source->report.groups.listed.size(), 2U);
    EXPECT_EQ(after.source->report.groups.listed[0], before->source->report.groups.listed[0]);
    EXPECT_EQ(after.source->report.findings.size(), before->source->report.findings.size());
    expect_same(after.source->report.quality, before->source->report.quality);
    ASSERT_EQ(after.representations.size(), 2U);
    for (std::size_t i : {0, 1}) expect_same(*after.representations[i], *before->representations[i]);
    EXPECT_EQ((*session)->find_made({{"", mesh.face_count()}, improving}), after.representations[0]);
    EXPECT_TRUE(after.interrupted.empty());
    EXPECT_EQ((*(*session)->add_representation({}, improved(mesh, {.faces = 400})))->id(), "r3") << "ids go on";
}

TEST_F(StoredSessionsTest, WhatIsDeletedReplacedOrExpiredStaysAway) {
    std::string deleted;
    std::string replaced;
    {
        ServerRun run(scratch_.path(), memory_);
        const auto gone = *run.store.create(run.source_of(test::cube()));
        const auto stays = *run.store.create(run.source_of(test::tetrahedron()));
        deleted = gone->id();
        replaced = stays->id();
        ASSERT_TRUE(stays->add_representation({}, improved(test::icosphere(2), {.faces = 100})));
        EXPECT_EQ(blobs().size(), 3U);
        ASSERT_TRUE(stays->set_source(run.source_of(test::icosphere(1))));
        EXPECT_EQ(blobs().size(), 2U) << "the mesh before and its representation went";
        ASSERT_TRUE(run.store.remove(deleted));
        EXPECT_EQ(blobs().size(), 1U);
    }
    ServerRun run(scratch_.path(), memory_);
    EXPECT_FALSE(run.store.find(deleted));
    const auto session = run.store.find(replaced);
    ASSERT_TRUE(session);
    EXPECT_EQ(**(*session)->snapshot().source->mesh->get(), test::icosphere(1));
    EXPECT_TRUE((*session)->snapshot().representations.empty());
    run.options.session_ttl = milliseconds(0);
    (*session)->touch();
    EXPECT_EQ(run.store.remove_expired(), 1U);
    EXPECT_TRUE(blobs().empty());
}

TEST_F(StoredSessionsTest, SessionsThatHaveTheSameMeshShareIt) {
    ServerRun run(scratch_.path(), memory_);
    const auto one = *run.store.create(run.source_of(test::cube()));
    const auto other = *run.store.create(run.source_of(test::cube()));
    EXPECT_EQ(blobs().size(), 1U);
    ASSERT_TRUE(run.store.remove(one->id()));
    EXPECT_EQ(blobs().size(), 1U);
    EXPECT_TRUE(other->snapshot().source->mesh->get());
    ASSERT_TRUE(run.store.remove(other->id()));
    EXPECT_TRUE(blobs().empty());
}

// Setting the clock or a long time down ends no session; the time that servers run does.
TEST_F(StoredSessionsTest, TimeGoesOnWhereItStopped) {
    std::string id;
    {
        ServerRun run(scratch_.path(), memory_);
        run.options.session_ttl = milliseconds(400);
        id = (*run.store.create(nullptr))->id();
        std::this_thread::sleep_for(milliseconds(100));
        ASSERT_TRUE(run.store.note_time());
    }
    std::this_thread::sleep_for(milliseconds(400));
    ServerRun run(scratch_.path(), memory_);
    EXPECT_EQ(run.store.remove_expired(), 0U);
    EXPECT_EQ(run.store.count(), 1U);
    std::this_thread::sleep_for(milliseconds(350));
    EXPECT_EQ(run.store.remove_expired(), 1U) << "100 ms and 350 ms are more than 400 ms";
}

TEST_F(StoredSessionsTest, UsesAreRemembered) {
    std::string used;
    std::string unused;
    {
        ServerRun run(scratch_.path(), memory_);
        run.options.session_ttl = milliseconds(200);
        used = (*run.store.create(nullptr))->id();
        unused = (*run.store.create(nullptr))->id();
        run.options.session_ttl = std::chrono::hours(1);
        ASSERT_TRUE(run.store.find(used));
        ASSERT_TRUE(run.store.note_time());
    }
    ServerRun run(scratch_.path(), memory_);
    std::this_thread::sleep_for(milliseconds(250));
    EXPECT_TRUE(run.store.find(used));
    EXPECT_FALSE(run.store.find(unused));
}

TEST_F(StoredSessionsTest, WhatWasCutOffIsToldUntilItIsAskedForAgain) {
    const MethodRequest cut{{"", 0}, ImproveOptions{.faces = 300}};
    const MethodRequest done{{"", 0}, ImproveOptions{.faces = 200}};
    std::string id;
    {
        ServerRun run(scratch_.path(), memory_);
        const auto session = *run.store.create(run.source_of(test::icosphere(3)));
        id = session->id();
        ASSERT_TRUE(run.archive->add_job(session->number(), cut));
        const auto job = run.archive->add_job(session->number(), done);
        ASSERT_TRUE(job && run.archive->remove_jobs({*job}));
        EXPECT_FALSE(run.archive->add_job(4711, cut)) << "no such session";
    }
    for (int restart = 0; restart < 2; ++restart) {
        ServerRun run(scratch_.path(), memory_);
        EXPECT_THAT((*run.store.find(id))->snapshot().interrupted, ::testing::ElementsAre(cut)) << restart;
        if (restart == 1) (*run.store.find(id))->answered(cut);
    }
    ServerRun run(scratch_.path(), memory_);
    EXPECT_TRUE((*run.store.find(id))->snapshot().interrupted.empty());
}

TEST_F(StoredSessionsTest, ADamagedSessionIsSetAsideAndTheOthersAreServed) {
    std::string damaged;
    std::string sound;
    {
        ServerRun run(scratch_.path(), memory_);
        sound = (*run.store.create(run.source_of(test::cube())))->id();
        damaged = (*run.store.create(run.source_of(test::icosphere(3))))->id();  // the last, whose number must not be used again
        for (const auto& blob : blobs()) {
            if (std::filesystem::file_size(blob) > 10'000) std::filesystem::resize_file(blob, 100);
        }
    }
    const std::size_t files = blobs().size();
    for (int restart = 0; restart < 2; ++restart) {
        ServerRun run(scratch_.path(), memory_);
        EXPECT_EQ(run.told.empty(), restart == 1) << run.told;
        const std::string expected = restart == 0 ? "session " + damaged + " is damaged and set aside" : "";
        EXPECT_THAT(run.told, HasSubstr(expected));
        EXPECT_EQ(run.store.find(damaged).error().cause, Cause::kCorrupt);
        EXPECT_THAT(run.store.find(damaged).error().message, HasSubstr("has 100 bytes instead of"));
        EXPECT_EQ(run.store.find(damaged, "ann").error().cause, Cause::kNotFound) << "it is somebody else's";
        EXPECT_TRUE(run.store.find(sound));
        EXPECT_EQ(run.archive->use().set_aside, 1U);
        EXPECT_EQ(blobs().size(), files) << "what is left of it is kept";
        EXPECT_TRUE(run.store.create(nullptr));
    }
    ServerRun run(scratch_.path(), memory_);
    EXPECT_EQ(run.store.remove(damaged, "ann").error().cause, Cause::kNotFound);
    EXPECT_TRUE(run.store.remove(damaged)) << "its owner may delete it";
    EXPECT_EQ(run.store.find(damaged).error().cause, Cause::kNotFound);
    EXPECT_EQ(run.archive->use().set_aside, 0U);
    EXPECT_EQ(blobs().size(), files - 1);
}

TEST_F(StoredSessionsTest, BytesThatChangedAreReportedWhenTheyAreUsed) {
    std::string id;
    {
        ServerRun run(scratch_.path(), memory_);
        id = (*run.store.create(run.source_of(test::icosphere(3))))->id();
    }
    std::ofstream(blobs().front(), std::ios::in | std::ios::out).write("?", 1);
    ServerRun run(scratch_.path(), memory_);
    const auto session = run.store.find(id);
    ASSERT_TRUE(session);
    EXPECT_EQ((*session)->snapshot().source->report.faces, 1280U) << "what the index says is sound";
    const auto mesh = (*session)->snapshot().source->mesh->get();
    ASSERT_FALSE(mesh);
    EXPECT_EQ(mesh.error().cause, Cause::kCorrupt);
    EXPECT_THAT(run.told, HasSubstr("does not hold the bytes"));
}

TEST_F(StoredSessionsTest, BlobsThatNobodyNeedsGoWithTheNextStart) {
    const auto index = [this] { return *SqliteSessionIndex::open(scratch_.path() / "sessions.db"); };
    {
        ServerRun run(scratch_.path(), memory_);
        ASSERT_TRUE(run.store.create(run.source_of(test::cube())));
    }
    const std::string key(64, '0');
    ASSERT_TRUE(index()->add_loose(key));
    const auto orphan = scratch_.path() / "blobs" / "00" / key;
    std::filesystem::create_directories(orphan.parent_path());
    std::ofstream(orphan) << "put, and then the process ended";
    ServerRun run(scratch_.path(), memory_);
    EXPECT_FALSE(std::filesystem::exists(orphan));
    EXPECT_EQ(blobs().size(), 1U);
    EXPECT_EQ(run.told, "");
}

// What an index has lost may be all that is left of sessions.
TEST_F(StoredSessionsTest, BlobsThatTheIndexDoesNotKnowArePutAside) {
    {
        ServerRun run(scratch_.path(), memory_);
        ASSERT_TRUE(run.store.create(run.source_of(test::cube())));
        ASSERT_TRUE(run.store.create(run.source_of(test::icosphere(2))));
    }
    for (const char* name : {"sessions.db", "sessions.db-wal", "sessions.db-shm"})
        std::filesystem::remove(scratch_.path() / name);
    ServerRun run(scratch_.path(), memory_);
    EXPECT_THAT(run.told, HasSubstr("2 of 2 stored meshes"));
    EXPECT_EQ(run.store.count(), 0U);
    EXPECT_EQ(blobs().size(), 2U) << "under blobs/aside";
    EXPECT_EQ(run.archive->use().bytes, 0U);
}

TEST_F(StoredSessionsTest, ARowThatChangedSetsItsSessionAsideUntilItIsMended) {
    std::string id;
    {
        ServerRun run(scratch_.path(), memory_);
        id = (*run.store.create(run.source_of(test::cube()), "ann"))->id();
    }
    const auto change = [this](const char* sql) { ASSERT_TRUE((*Database::open(scratch_.path() / "sessions.db")).run(sql)); };
    change("UPDATE sessions SET owner = 'bob'");
    {
        ServerRun run(scratch_.path(), memory_);
        EXPECT_THAT(run.told, HasSubstr("not as it was written"));
        EXPECT_FALSE(run.store.find(id, "bob"));
        EXPECT_EQ(run.archive->use().set_aside, 1U);
    }
    change("UPDATE sessions SET owner = 'ann'");
    ServerRun run(scratch_.path(), memory_);
    EXPECT_THAT(run.told, HasSubstr("is sound again"));
    EXPECT_TRUE(run.store.find(id, "ann"));
    EXPECT_EQ(run.archive->use().set_aside, 0U);
}

TEST_F(StoredSessionsTest, AClockThatChangedLetsNothingExpire) {
    const auto change = [this](const char* sql) { ASSERT_TRUE((*Database::open(scratch_.path() / "sessions.db")).run(sql)); };
    std::string id;
    {
        ServerRun run(scratch_.path(), memory_);
        id = (*run.store.create(run.source_of(test::cube())))->id();
    }
    for (const char* damage :
         {"UPDATE clock SET now = now + 1099511627776", "UPDATE clock SET now = -now - 5", "DELETE FROM clock"}) {
        change(damage);
        {
            ServerRun run(scratch_.path(), memory_);
            EXPECT_THAT(run.told, HasSubstr("clock is not as it was written")) << damage;
            EXPECT_EQ(run.store.remove_expired(), 0U);
            EXPECT_TRUE(run.store.find(id)) << damage;
            ASSERT_TRUE(run.store.note_time());
        }
        ServerRun run(scratch_.path(), memory_);
        EXPECT_EQ(run.told, "") << "it goes on from there";
        EXPECT_TRUE(run.store.find(id)) << damage;
    }
}

TEST_F(StoredSessionsTest, ALifeThatChangedSetsItsSessionAside) {
    const auto change = [this](const char* sql) { ASSERT_TRUE((*Database::open(scratch_.path() / "sessions.db")).run(sql)); };
    std::string id;
    {
        ServerRun run(scratch_.path(), memory_);
        const auto session = *run.store.create(run.source_of(test::icosphere(2)));
        id = session->id();
        ASSERT_TRUE(session->add_representation({}, improved(test::icosphere(2), {.faces = 100})));
        session->touch();
        ASSERT_TRUE(run.store.note_time());
    }
    for (const char* damage :
         {"UPDATE sessions SET expires = expires - 4096", "UPDATE sessions SET expires = expires + 4096, made = 0"}) {
        change(damage);
        ServerRun run(scratch_.path(), memory_);
        EXPECT_EQ(run.archive->use().set_aside, 1U) << damage;
        EXPECT_EQ(run.store.remove_expired(), 0U);
        EXPECT_EQ(blobs().size(), 2U);
    }
}

// Version 1 had no digests of what changes at every use.
TEST_F(StoredSessionsTest, AnIndexOfVersion1IsTakenOver) {
    std::string id;
    {
        ServerRun run(scratch_.path(), memory_);
        id = (*run.store.create(run.source_of(test::cube())))->id();
    }
    {
        auto index = *Database::open(scratch_.path() / "sessions.db");
        ASSERT_TRUE(
            index.run("ALTER TABLE sessions DROP COLUMN life; ALTER TABLE clock DROP COLUMN digest; ALTER TABLE jobs DROP COLUMN "
                      "digest; PRAGMA user_version = 1"));
    }
    for (int restart = 0; restart < 2; ++restart) {
        ServerRun run(scratch_.path(), memory_);
        EXPECT_EQ(run.told, "");
        EXPECT_TRUE(run.store.find(id));
    }
}

// By whatever program: what is a session's goes with its row, and its number is not used again.
TEST_F(StoredSessionsTest, ARowThatIsDeletedTakesAllWithIt) {
    {
        ServerRun run(scratch_.path(), memory_);
        const auto session = *run.store.create(run.source_of(test::icosphere(2)), "ann");
        ASSERT_TRUE(session->add_representation({}, improved(test::icosphere(2), {.faces = 100})));
    }
    ASSERT_TRUE((*Database::open(scratch_.path() / "sessions.db")).run("DELETE FROM sessions"));
    std::string id;
    {
        ServerRun run(scratch_.path(), memory_);
        EXPECT_TRUE(blobs().empty());
        id = (*run.store.create(nullptr, "bob"))->id();
    }
    ServerRun run(scratch_.path(), memory_);
    const auto session = run.store.find(id, "bob");
    ASSERT_TRUE(session);
    EXPECT_EQ((*session)->number(), 2U);
    EXPECT_TRUE((*session)->snapshot().representations.empty());
}

TEST_F(StoredSessionsTest, WhatDoesNotFitTheQuotaLeavesNothing) {
    ServerRun run(scratch_.path(), memory_, 1000);
    ASSERT_TRUE(run.store.create(run.source_of(test::cube())));
    const auto refused = run.store.create(run.source_of(test::icosphere(3)));
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().cause, Cause::kLimitExceeded);
    EXPECT_EQ(run.store.count(), 1U);
    const auto session = *run.store.create(nullptr);
    EXPECT_FALSE(session->set_source(run.source_of(test::icosphere(3))));
    EXPECT_EQ(session->snapshot().source, nullptr);
    EXPECT_TRUE(session->require_idle());
    EXPECT_FALSE(session->add_representation({}, improved(test::icosphere(3), {.faces = 100})));
    EXPECT_TRUE(session->snapshot().representations.empty());
}

// Twenty sessions in the memory of two: everything is served, and memory is kept.
TEST_F(StoredSessionsTest, SessionsLeaveMemoryAndComeBack) {
    const TriangleMesh mesh = test::icosphere(4);
    service::MemoryBudget small(2 * (mesh.positions.size() * 24 + mesh.faces.size() * 12) + 1000);
    ServerRun run(scratch_.path(), small);
    std::vector<std::string> ids;
    for (int i = 0; i < 20; ++i) {
        TriangleMesh moved = mesh;
        for (Vec3& position : moved.positions) position.x() += i;
        ids.push_back((*run.store.create(run.source_of(moved)))->id());
    }
    EXPECT_LE(small.use().bytes, small.use().limit);
    for (std::size_t i = 0; i < ids.size(); ++i) {
        const auto read = (*run.store.find(ids[i]))->snapshot().source->mesh->get();
        ASSERT_TRUE(read) << read.error().message;
        EXPECT_EQ((*read)->positions[0].x(), mesh.positions[0].x() + static_cast<double>(i));
        EXPECT_LE(small.use().bytes, small.use().limit);
    }
    EXPECT_GE(small.use().evictions, 36U);
}

}  // namespace
}  // namespace vsplit::store

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <ostream>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "tests/core/meshes.h"
#include "tests/core/random.h"
#include "tests/core/sampled_deviation.h"
#include "vsplit/io/read_mesh.h"
#include "vsplit/mesh/inspect.h"
#include "vsplit/method/control.h"
#include "vsplit/method/improve.h"
#include "vsplit/mrr/mrr_file.h"
#include "vsplit/mrr/progressive_mesh.h"
#include "vsplit/quality/deviation.h"

/// The extended mode as a user meets it: both methods from a mesh to an MRR.
namespace vsplit::test {
namespace {

TriangleMesh data(const std::string& name) {
    auto read = read_mesh_file(data_file(name), {});
    EXPECT_TRUE(read) << read.error().message;
    return std::move(read->mesh);
}

/// What is asked for in every test; the meshes are cut no finer than a few seconds allow.
struct Job {
    std::string name;
    std::function<TriangleMesh()> source;
    std::optional<ImproveOptions> improving{};
    std::optional<ControlOptions> controlling{};
};

std::ostream& operator<<(std::ostream& out, const Job& job) { return out << job.name; }

std::vector<Job> jobs() {
    return {
        {"improve_bracket", [] { return data("bracket.stl"); }, ImproveOptions{.subdivision_size = 8, .faces = 7000}},
        {"improve_combined", [] { return data("combined.stl"); }, ImproveOptions{.subdivision_size = 3.5, .faces = 6001}},
        {"improve_scan", [] { return data("scan.ply"); }, ImproveOptions{.tolerance = 0.5, .faces = 16000}},
        {"improve_torus", [] { return torus(40, 16); },
         ImproveOptions{.subdivision_size = 0.12, .tolerance = 0.05, .faces = 900}},
        {"control_bumpy", [] { return bumpy_sphere(4, 0.01, 5); }, {}, ControlOptions{.tolerance = 0.05, .faces = 2000}},
        {"control_combined", [] { return data("combined.stl"); }, {}, ControlOptions{.subdivisions = 1, .faces = 8000}},
        {"control_plate", [] { return plate_with_holes(4); }, {}, ControlOptions{.subdivisions = 3, .faces = 2000}},
    };
}

Expected<MethodResult> run(
    const Job& job, const TriangleMesh& source, const ExecutionContext& context,
    const std::function<void(std::optional<double>& max_deviation, std::optional<Mode>& mode)>& with = {}) {
    if (job.improving) {
        ImproveOptions options = *job.improving;
        if (with) with(options.max_deviation, options.mode);
        return improve(source, options, {}, context);
    }
    ControlOptions options = *job.controlling;
    if (with) with(options.max_deviation, options.mode);
    return control(source, options, {}, context);
}

MethodResult done(Expected<MethodResult> result) {
    EXPECT_TRUE(result) << result.error().message;
    return result ? std::move(*result) : MethodResult{};
}

TriangleMesh shown(const MethodResult& result) { return mesh_at(result.mrr, result.mrr.level_for(result.faces)); }

class Extended : public testing::TestWithParam<Job> {
protected:
    const TriangleMesh source_ = GetParam().source();
    const ExecutionContext context_{};
};

TEST_P(Extended, LevelsAreManifoldsOfTheSourcesTopologyAndGoBackExactly) {
    const MethodResult result = done(run(GetParam(), source_, context_));
    ASSERT_GT(result.mrr.levels(), 100U);
    EXPECT_EQ(result.faces_subdivided, result.mrr.faces_max());
    const MeshReport before = inspect(source_);
    Random random(1);
    auto mesh = ProgressiveMesh::from_base(result.mrr.base);
    ASSERT_TRUE(mesh);
    for (int n = 0; n < 8; ++n) {
        const std::size_t level = n == 0 ? result.mrr.levels() : random.below(static_cast<std::uint32_t>(result.mrr.levels()));
        ASSERT_TRUE(mesh->refine(result.mrr.records.slice(0, result.mrr.record_of_level(level))));
        EXPECT_EQ(mesh->mesh().face_count(), result.mrr.faces_at(level));
        const MeshReport now = inspect(mesh->mesh());
        EXPECT_TRUE(now.closed) << level;
        EXPECT_EQ(now.genus, before.genus) << level;
        EXPECT_EQ(now.components, before.components) << level;
        const std::size_t part = random.below(static_cast<std::uint32_t>(level) + 1);
        mesh->coarsen(part);
        ASSERT_EQ(mesh->mesh(), mesh_at(result.mrr, level - part)) << level << " less " << part;
        mesh->coarsen(level - part);
        ASSERT_EQ(mesh->level(), 0U);
        ASSERT_EQ(mesh->mesh(), result.mrr.base) << level;
    }
}

TEST_P(Extended, SameBytesForAnyNumberOfThreadsAndAgain) {
    std::vector<std::string> bytes;
    std::vector<Quality> qualities;
    for (const unsigned threads : {1U, 2U, 2U}) {
        const ExecutionContext context(nullptr, threads);
        const MethodResult result = done(run(GetParam(), source_, context));
        bytes.push_back(encode_mrr({result.mrr, result.faces, ""}));
        qualities.push_back(result.quality);
    }
    EXPECT_GT(bytes[0].size(), 1000U);
    for (const std::size_t n : {1U, 2U}) {
        EXPECT_TRUE(bytes[n] == bytes[0]) << n;
        EXPECT_EQ(qualities[n].deviation_max, qualities[0].deviation_max) << n;
        EXPECT_EQ(qualities[n].crease_deviation_max, qualities[0].crease_deviation_max) << n;
        EXPECT_EQ(qualities[n].stretch_mean, qualities[0].stretch_mean) << n;
    }
}

TEST_P(Extended, ShapeIsBetterThanTheStrictModes) {
    const MethodResult extended = done(run(GetParam(), source_, context_));
    const MethodResult strict = done(run(GetParam(), source_, context_, [](auto&, auto& mode) { mode = Mode::kStrict; }));
    EXPECT_EQ(extended.faces, strict.faces) << "else nothing is compared";
    // What control asks for are bounds and even sizes; strict mode may leave a better mean by leaving violators.
    if (GetParam().improving) {
        EXPECT_GT(extended.quality.stretch_mean, strict.quality.stretch_mean);
    }
    // Creases that noise made of a scan are kept, which may cost the worst face; strict mode lets them go.
    EXPECT_LE(extended.quality.faces_below_02, strict.quality.faces_below_02);
    EXPECT_GE(extended.quality.stretch_p01, strict.quality.stretch_p01);
    EXPECT_FALSE(strict.quality.deviation_max.has_value());
}

TEST_P(Extended, TheDeviationIsMeasured) {
    const MethodResult result = done(run(GetParam(), source_, context_));
    const TriangleMesh mesh = shown(result);
    ASSERT_TRUE(result.quality.deviation_max.has_value());
    const auto again = measure_deviation(mesh, source_, {}, context_);
    ASSERT_TRUE(again);
    EXPECT_EQ(*result.quality.deviation_max, again->max());
    const double sampled = std::max(sampled_deviation(mesh, source_, 4), sampled_deviation(source_, mesh, 4));
    EXPECT_LE(sampled, *result.quality.deviation_max * (1 + 1e-9));
    EXPECT_GT(*result.quality.deviation_max, 0);
    const Quality wanted = measure_quality(mesh);
    EXPECT_EQ(result.quality.stretch_min, wanted.stretch_min);
    EXPECT_EQ(result.quality.stretch_mean, wanted.stretch_mean);
    EXPECT_EQ(result.quality.faces, result.faces);
}

class ExtendedWithin : public testing::TestWithParam<std::tuple<Job, double>> {};

TEST_P(ExtendedWithin, AMaximalDeviationThatIsGivenIsNeverExceeded) {
    const auto& [job, share] = GetParam();
    const ExecutionContext context;
    const TriangleMesh source = job.source();
    const double limit = share * bounding_box(source).diagonal();
    const MethodResult result = done(run(job, source, context, [limit](auto& bound, auto&) { bound = limit; }));
    ASSERT_TRUE(result.quality.deviation_max.has_value());
    EXPECT_LE(*result.quality.deviation_max, limit) << result.faces << " faces of at most " << result.mrr.faces_max();
    const TriangleMesh mesh = shown(result);
    EXPECT_LE(sampled_deviation(mesh, source, 3), limit * (1 + 1e-9));
    EXPECT_LE(sampled_deviation(source, mesh, 3), limit * (1 + 1e-9));
}

std::string job_name(const testing::TestParamInfo<Job>& info) { return info.param.name; }
INSTANTIATE_TEST_SUITE_P(Both, Extended, testing::ValuesIn(jobs()), job_name);

/// The share of the diagonal in millionths.
std::string within_name(const testing::TestParamInfo<std::tuple<Job, double>>& info) {
    return std::get<0>(info.param).name + "_" + std::to_string(std::lround(1e6 * std::get<1>(info.param)));
}
INSTANTIATE_TEST_SUITE_P(Both, ExtendedWithin, testing::Combine(testing::ValuesIn(jobs()), testing::Values(3e-3, 3e-4, 3e-5)),
                         within_name);

TEST(ExtendedTest, ADeviationFarBelowTheDefaultIsKeptToo) {
    const ExecutionContext context;
    for (const TriangleMesh& source : {plate_with_holes(1), bumpy_sphere(3, 0.02, 3)}) {
        const double diagonal = bounding_box(source).diagonal();
        for (const double share : {1e-5, 3e-6, 1e-6, 1e-7}) {
            const double limit = share * diagonal;
            const ImproveOptions options{.subdivision_size = 0.05 * diagonal, .max_deviation = limit, .faces = 500};
            const MethodResult result = done(improve(source, options, {}, context));
            ASSERT_TRUE(result.quality.deviation_max.has_value());
            EXPECT_LE(*result.quality.deviation_max, limit)
                << share << " of the diagonal; sampled " << sampled_deviation(shown(result), source, 4) / diagonal;
        }
    }
}

/// What control promises, counted face by face without its help.
void expect_bounds_on_every_face(const TriangleMesh& mesh, const ControlOptions& bounds) {
    std::vector<std::uint32_t> valence(mesh.positions.size(), 0);
    for (const Triangle& t : mesh.faces) {
        const Vec3 &a = mesh.positions[t[0]], &b = mesh.positions[t[1]], &c = mesh.positions[t[2]];
        const double ab = (b - a).norm(), bc = (c - b).norm(), ca = (a - c).norm();
        const double radius = (b - a).cross(c - a).norm() / (ab + bc + ca);
        EXPECT_GE(std::sqrt(12) * radius / std::max({ab, bc, ca}), *bounds.min_stretch - 1e-12);
        EXPECT_LE(std::max({ab, bc, ca}), *bounds.max_size * (1 + 1e-12));
        for (const std::uint32_t v : t) ++valence[v];
    }
    EXPECT_LE(*std::max_element(valence.begin(), valence.end()), *bounds.max_valence);
}

TEST(ExtendedTest, BoundsThatAreReportedKeptHoldOnEveryFace) {
    const ExecutionContext context;
    int kept = 0;
    for (const TriangleMesh& source :
         {icosphere(3), bumpy_sphere(3, 0.01, 2), torus(30, 12), plate_with_holes(2), data("combined.stl")}) {
        for (const double stretch : {0.2, 0.5}) {
            ControlOptions options{.min_stretch = stretch, .max_size = 0.08 * bounding_box(source).diagonal(), .max_valence = 8};
            options.faces = source.face_count() / 2;
            options.subdivisions = source.face_count() > 5000 ? 0 : 1;
            const MethodResult result = done(control(source, options, {}, context));
            const auto violations = find_violations(shown(result), options);
            EXPECT_EQ(result.bounds_satisfied(), violations.empty());
            if (!result.bounds_satisfied()) continue;
            expect_bounds_on_every_face(shown(result), options);
            ++kept;
        }
    }
    EXPECT_GE(kept, 5) << "else nothing was tested";
}

TEST(ExtendedTest, FlipsAndMovesBreakNoBoundThatHolds) {
    const ExecutionContext context;
    ControlOptions options{.tolerance = 0.2, .min_stretch = 0.5, .max_size = 0.5, .max_valence = 8, .faces = 300};
    const MethodResult result = done(control(icosphere(3), options, {}, context));
    ASSERT_GT(result.mrr.levels(), 300U);
    EXPECT_GT(result.mrr.records.moves().size(), 0U);
    for (std::size_t level = 0; level <= result.mrr.levels(); level += 53) {
        expect_bounds_on_every_face(mesh_at(result.mrr, level), options);
    }
}

TEST(ExtendedTest, TheStrictModeHasNoFlipsMovesOrBoundOnTheDeviation) {
    const ExecutionContext context;
    const TriangleMesh source = bumpy_sphere(3, 0.01, 7);
    const auto records = [](const MethodResult& result) {
        return std::pair(result.mrr.records.flips().size(), result.mrr.records.moves().size());
    };
    const auto strict_improve = done(improve(source, {.mode = Mode::kStrict}, {}, context));
    const auto strict_control = done(control(source, {.mode = Mode::kStrict}, {}, context));
    EXPECT_EQ(records(strict_improve), std::pair(std::size_t{0}, std::size_t{0}));
    EXPECT_EQ(records(strict_control), std::pair(std::size_t{0}, std::size_t{0}));
    const auto [flips, moves] = records(done(improve(source, {.mode = Mode::kExtended}, {}, context)));
    EXPECT_GT(flips, 0U);
    EXPECT_GT(moves, 0U);

    const auto refused_improve = improve(source, {.max_deviation = 0.1, .mode = Mode::kStrict}, {}, context);
    const auto refused_control = control(source, {.max_deviation = 0.1, .mode = Mode::kStrict}, {}, context);
    for (const auto* refused : {&refused_improve, &refused_control}) {
        ASSERT_FALSE(*refused);
        EXPECT_EQ(refused->error().cause, Cause::kUnsupported);
        EXPECT_EQ(refused->error().field, "max_deviation");
        EXPECT_NE(refused->error().message.find("tolerance"), std::string::npos) << "what to do instead";
    }
}

TEST(ExtendedTest, ADeviationThatCannotBeIsRefused) {
    const ExecutionContext context;
    TriangleMesh far = cube();
    for (Vec3& p : far.positions) p += Vec3(1e6, 0, 0);
    const auto cause = [&](const TriangleMesh& mesh, double max_deviation) {
        const auto improved = improve(mesh, {.subdivision_size = 0.5, .max_deviation = max_deviation}, {}, context);
        const auto controlled = control(mesh, {.max_deviation = max_deviation}, {}, context);
        EXPECT_EQ(improved.has_value(), controlled.has_value());
        if (improved) return std::optional<Cause>();
        EXPECT_EQ(improved.error().field, "max_deviation");
        EXPECT_EQ(controlled.error().field, "max_deviation");
        EXPECT_EQ(improved.error().cause, controlled.error().cause);
        return std::optional(improved.error().cause);
    };
    for (const double bad :
         {0.0, -1.0, 1e-10, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
        EXPECT_EQ(cause(cube(), bad), Cause::kInvalidOption) << bad;
    }
    EXPECT_EQ(cause(far, 1e-4), Cause::kInvalidOption) << "coordinates of a million resolve no less than a thousandth";
    EXPECT_EQ(cause(far, 2e-3), std::nullopt);
    EXPECT_EQ(cause(cube(), 1e-3), std::nullopt);
}

TEST(ExtendedTest, TolerancesFollowFromEachOther) {
    const TriangleMesh source = icosphere(2);
    const double diagonal = bounding_box(source).diagonal();
    const auto expect_both = [&](std::optional<double> tolerance, std::optional<double> deviation, double tolerance_used,
                                 double deviation_used) {
        const ImproveOptions improving{.tolerance = tolerance, .max_deviation = deviation};
        const ControlOptions controlling{.tolerance = tolerance, .max_deviation = deviation};
        const ImproveOptions a = default_options(source, improving, {});
        const ControlOptions b = default_options(source, controlling);
        EXPECT_DOUBLE_EQ(*a.tolerance, tolerance_used);
        EXPECT_DOUBLE_EQ(*b.tolerance, tolerance_used);
        EXPECT_DOUBLE_EQ(*a.max_deviation, deviation_used);
        EXPECT_DOUBLE_EQ(*b.max_deviation, deviation_used);
    };
    expect_both({}, {}, 1e-3 * diagonal, 2e-3 * diagonal);
    expect_both(0.01, {}, 0.01, 0.02);
    expect_both({}, 0.01, 0.005, 0.01);
    expect_both(0.5, 0.01, 0.5, 0.01);
}

TEST(ExtendedTest, ObeysTheLeastFacesWhateverIsAskedFor) {
    const ExecutionContext context;
    const TriangleMesh source = icosphere(3);
    constexpr std::uint32_t kAll = std::numeric_limits<std::uint32_t>::max();
    for (const std::uint32_t faces : {600U, 601U, 1000U, 1'000'000U, 4'000'000'000U, kAll - 1, kAll}) {
        for (const std::uint32_t least : {4U, 600U}) {
            const ControlOptions options{.subdivisions = 0, .tolerance = 0.5, .faces = faces, .faces_min = least};
            const MethodResult result = done(control(source, options, {}, context));
            EXPECT_GE(result.mrr.faces_min(), least) << "faces " << faces;
            EXPECT_LE(result.mrr.faces_min(), std::max(least, 40U)) << "faces " << faces;
            EXPECT_EQ(result.faces, std::min(faces & ~1U, source.face_count()));
        }
    }
    const MethodResult none = done(control(source, {.tolerance = 0.5, .faces_min = kAll}, {}, context));
    EXPECT_EQ(none.mrr.faces_min(), none.mrr.faces_max()) << "fewer than there are were not allowed";
}

/// Stages in the order they were first reported in.
std::vector<std::string> stages(const TriangleMesh& source, const ImproveOptions& options) {
    std::vector<std::string> all;
    double simplified = 0;
    const ExecutionContext context([&](const Progress& progress) {
        const std::string stage(progress.stage);
        if (std::find(all.begin(), all.end(), stage) == all.end()) all.push_back(stage);
        EXPECT_GE(progress.fraction, 0);
        EXPECT_LE(progress.fraction, 1);
        if (stage != "simplify") return;
        EXPECT_GE(progress.fraction, simplified);
        simplified = progress.fraction;
    });
    done(improve(source, options, {}, context));
    EXPECT_EQ(simplified, 1);
    return all;
}

TEST(ExtendedTest, ACancelIsObeyedInEveryStage) {
    const TriangleMesh source = bumpy_sphere(4, 0.01, 3);
    const ImproveOptions options{.subdivision_size = 0.06, .faces = 2000};
    const std::vector<std::string> all = stages(source, options);
    EXPECT_EQ(all, (std::vector<std::string>{"inspect", "subdivide", "evaluate", "simplify", "measure"}));
    for (const std::string& stage : all) {
        ExecutionContext* running = nullptr;
        ExecutionContext context([&](const Progress& progress) {
            if (progress.stage == stage) running->cancel();
        });
        running = &context;
        const auto result = improve(source, options, {}, context);
        ASSERT_FALSE(result) << stage;
        EXPECT_EQ(result.error().cause, Cause::kCancelled) << stage;
    }
}

}  // namespace
}  // namespace vsplit::test

#include "method/nearby_faces.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "tests/core/bound_count.h"
#include "tests/core/meshes.h"
#include "vsplit/method/control.h"
#include "vsplit/mrr/progressive_mesh.h"

namespace vsplit::test {
namespace {

/// Resolutions of a sphere from fine to coarse, made without a bound.
MultiresMesh resolutions() {
    const ExecutionContext context;
    auto made = control(icosphere(3), {.subdivisions = 0, .tolerance = 0.1, .min_stretch = 0, .faces = 400}, {}, context);
    EXPECT_TRUE(made);
    return std::move(made->mrr);
}

bool holds(const MultiresMesh& mrr, std::uint32_t faces, const ControlOptions& options) {
    return broken_bounds(mesh_at(mrr, mrr.level_for(faces)), options, 1e-9).empty();
}

TEST(NearbyFacesTest, TakesWhatIsAskedForWhereItHoldsElseOneNearbyThatDoesElseWhatIsAskedFor) {
    const MultiresMesh mrr = resolutions();
    int moved = 0, stayed = 0, none = 0;
    for (int step = 5; step < 35; ++step) {
        const double limit = 0.02 * step;
        for (const bool given : {false, true}) {
            for (const bool upper : {false, true}) {
                ControlOptions options{.faces = 400};
                (upper ? options.max_size : options.min_size) = limit;
                const std::uint32_t faces = faces_that_keep_bounds(mrr, options, given);
                if (holds(mrr, 400, options)) {
                    EXPECT_EQ(faces, 400U);
                    ++stayed;
                } else if (faces == 400) {
                    ++none;
                } else {
                    EXPECT_TRUE(holds(mrr, faces, options)) << limit;
                    ++moved;
                }
                if (given) {
                    EXPECT_LE(std::abs(static_cast<int>(faces) - 400), 40);
                }
                if (upper) {
                    EXPECT_GE(faces, 198U);
                }
            }
        }
    }
    EXPECT_GT(moved, 5);
    EXPECT_GT(stayed, 5);
    EXPECT_GT(none, 5);
}

TEST(NearbyFacesTest, AnyNumberOfFacesWillDo) {
    const MultiresMesh mrr = resolutions();
    for (const std::uint32_t faces : {4U, 5U, 1280U, 4'000'000'000U, 0xFFFFFFFFU}) {
        for (const bool given : {false, true}) {
            EXPECT_EQ(faces_that_keep_bounds(mrr, {.max_size = 1e-9, .faces = faces}, given), faces);
            EXPECT_EQ(faces_that_keep_bounds(mrr, {.faces = faces}, given), faces);
        }
    }
}

}  // namespace
}  // namespace vsplit::test

#include "features/crease_noise.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/core/meshes.h"

namespace vsplit {
namespace {

/// Vertices on a grid with a spacing of 1, named by column and row; faces give it an area of `width` * `height`.
struct Grid {
    std::uint32_t width = 0;
    TriangleMesh mesh;

    Grid(std::uint32_t w, std::uint32_t h) : width(w) {
        for (std::uint32_t y = 0; y <= h; ++y) {
            for (std::uint32_t x = 0; x <= w; ++x) mesh.positions.emplace_back(x, y, 0);
        }
        const std::uint32_t corners[] = {at(0, 0), at(w, 0), at(w, h), at(0, h)};
        mesh.faces = {{corners[0], corners[1], corners[2]}, {corners[0], corners[2], corners[3]}};
    }

    [[nodiscard]] std::uint32_t at(std::uint32_t x, std::uint32_t y) const { return y * (width + 1) + x; }

    /// Edges from (x, y) on, `n` to the right or down.
    void draw(std::vector<SharpEdge>& creases, std::uint32_t x, std::uint32_t y, std::uint32_t n, bool across) const {
        for (std::uint32_t i = 0; i < n; ++i) {
            creases.push_back(across ? SharpEdge{at(x + i, y), at(x + i + 1, y), 1}
                                     : SharpEdge{at(x, y + i), at(x, y + i + 1), 1});
        }
    }
};

std::size_t left(const Grid& grid, const std::vector<SharpEdge>& creases, double least) {
    return without_noise(creases, grid.mesh, least).size();
}

TEST(CreaseNoiseTest, TakesShortBranchesOffALongCreaseThatStays) {
    const Grid grid(12, 4);
    std::vector<SharpEdge> creases;
    grid.draw(creases, 0, 2, 12, true);                                             // the crease, with ends of its own
    for (const std::uint32_t x : {2U, 5U, 9U}) grid.draw(creases, x, 2, 1, false);  // frays by one edge each
    EXPECT_EQ(left(grid, creases, 1.5), 12U);
    EXPECT_EQ(left(grid, creases, 0.5), 15U);
    EXPECT_EQ(left(grid, creases, 0), 15U);
    for (const SharpEdge& kept : without_noise(creases, grid.mesh, 1.5)) EXPECT_EQ(kept.a / 13, kept.b / 13) << "along the row";
}

TEST(CreaseNoiseTest, KeepsClosedCreasesHoweverSmall) {
    const Grid grid(8, 4);
    std::vector<SharpEdge> creases;
    grid.draw(creases, 1, 1, 1, true);
    grid.draw(creases, 1, 2, 1, true);
    grid.draw(creases, 1, 1, 1, false);
    grid.draw(creases, 2, 1, 1, false);
    grid.draw(creases, 5, 1, 2, true);  // one that is not
    EXPECT_EQ(left(grid, creases, 3), 4U);
}

TEST(CreaseNoiseTest, KeepsAllWhereFewAreShort) {
    const Grid grid(40, 40);
    std::vector<SharpEdge> creases;
    grid.draw(creases, 3, 3, 1, true);
    EXPECT_EQ(left(grid, creases, 2), 1U) << "a strip of 2 along one edge of 1600";
    for (std::uint32_t y = 5; y < 40; y += 2) grid.draw(creases, 3, y, 1, true);
    EXPECT_EQ(left(grid, creases, 2), 0U) << "18 edges: 36 of 1600";
}

/// Of a Y of two short arms and a long one the shorter arm goes; what is left is one crease.
TEST(CreaseNoiseTest, ShortestBranchesGoFirst) {
    const Grid grid(8, 8);
    std::vector<SharpEdge> creases;
    grid.draw(creases, 0, 4, 4, true);
    grid.draw(creases, 4, 4, 2, true);
    grid.draw(creases, 4, 4, 1, false);
    const std::vector<SharpEdge> kept = without_noise(creases, grid.mesh, 3);
    EXPECT_EQ(kept.size(), 6U);
    EXPECT_TRUE(std::all_of(kept.begin(), kept.end(), [&](const SharpEdge& e) { return e.a / 9 == 4 && e.b / 9 == 4; }));
}

}  // namespace
}  // namespace vsplit

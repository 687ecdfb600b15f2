#include "simplify/polish.h"

#include <gtest/gtest.h>

#include <memory>

#include "tests/core/meshes.h"
#include "tests/core/polishing.h"
#include "tests/core/random.h"

namespace vsplit {
namespace {

/// A mesh with the guards that the extended mode sets over it.
struct Guarded {
    test::Polishing parts;
    SurfaceIndex source;
    DeviationGuard surface;
    CreaseGuard creases;

    explicit Guarded(const TriangleMesh& mesh)
        : parts(mesh, 0.01),
          source(surface_index(parts.input.mesh)),
          surface(parts.mesh, source, limit(mesh), kNone, parts.state.border),
          creases(parts.mesh, parts.input.creases, limit(mesh)) {}

    static double limit(const TriangleMesh& mesh) { return 0.01 * bounding_box(mesh).diagonal(); }
    Guards guards() { return {&surface, &creases}; }
    [[nodiscard]] PolishLimits limits() const {
        PolishLimits limits = parts.limits();
        limits.crease_cosine = parts.input.crease_cosine;
        return limits;
    }
};

/// The rounds taken literally: every edge and every vertex in each of them, by parts that remember nothing.
void polish_literally(Guarded& g, int relaxations, int lifts) {
    const auto flip = [&g] { EdgeFlipper(g.parts.mesh, g.parts.state, g.parts.log, g.guards(), g.limits()).flip_all(); };
    for (int round = 0; round < relaxations + lifts; ++round) {
        flip();
        VertexMover mover(g.parts.mesh, g.parts.state, g.parts.log, g.guards(), g.limits());
        for (std::uint32_t v = 0; v < g.parts.mesh.vertex_count(); ++v) {
            if (g.parts.mesh.outgoing(v) == kNone) continue;
            round < relaxations ? mover.relax(v) : mover.lift(v, 0.72);
        }
    }
    flip();
}

void push_about(Guarded& g, std::uint64_t seed) {
    test::Random random(seed);
    VertexMover mover(g.parts.mesh, g.parts.state, g.parts.log, g.guards(), g.limits());
    for (int n = 0; n < 20; ++n) mover.lift(static_cast<std::uint32_t>(random.uniform(0, g.parts.mesh.vertex_count())), 1);
}

void expect_same(const Guarded& one, const Guarded& other) {
    const TriangleMesh a = one.parts.now(), b = other.parts.now();
    EXPECT_EQ(a.faces, b.faces);
    ASSERT_EQ(a.positions.size(), b.positions.size());
    std::size_t differ = 0;
    for (std::size_t v = 0; v < a.positions.size(); ++v) differ += a.positions[v] == b.positions[v] ? 0 : 1;
    EXPECT_EQ(differ, 0U);
}

TEST(PolishTest, WhatIsLeftOutWouldHaveStayed) {
    const std::vector<TriangleMesh> meshes = {test::noisy_cube(9, 0.03, 1), test::jittered_cube(8, 0.15, 2),
                                              test::bumpy_sphere(3, 0.02, 3),
                                              test::punctured(test::bumpy_sphere(3, 0.02, 4), {7, 90})};
    for (const TriangleMesh& mesh : meshes) {
        Guarded lazy(mesh), literal(mesh);
        Polisher polisher(lazy.parts.mesh, lazy.parts.state, lazy.parts.log, lazy.guards(), lazy.limits());
        for (const std::uint64_t seed : {11, 12, 13}) {
            polisher.polish(5, VertexMover::Moves::kAll, 2, ExecutionContext());
            polish_literally(literal, 5, 2);
            expect_same(lazy, literal);
            push_about(lazy, seed);
            push_about(literal, seed);
        }
    }
}

TEST(PolishTest, TheClockTellsWhatChanged) {
    test::Polishing p(test::icosphere(2), 0.01);
    const std::uint32_t before = p.mesh.clock();
    p.mesh.move(5, p.mesh.position(5) * 1.001);
    EXPECT_GT(p.mesh.clock(), before);
    std::size_t touched = 0;
    for (std::uint32_t v = 0; v < p.mesh.vertex_count(); ++v) touched += p.mesh.changed_at(v) > before ? 1 : 0;
    EXPECT_EQ(touched, p.mesh.valence(5) + 1U);
}

}  // namespace
}  // namespace vsplit

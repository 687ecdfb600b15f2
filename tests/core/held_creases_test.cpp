#include "quality/held_creases.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <optional>

#include "quality/sliver_mends.h"
#include "spatial/surface_index.h"
#include "tests/core/meshes.h"
#include "tests/core/random.h"
#include "vsplit/quality/stretch.h"

namespace vsplit::test {
namespace {

constexpr double kAngle = 40;
constexpr double kReach = 0.02;

/// Random creases all over, and a sliver wherever a vertex has gone most of the way to a neighbour.
TriangleMesh crumpled(std::uint64_t seed) {
    TriangleMesh mesh = noisy_cube(4, 0.35, seed);
    Random random(seed);
    for (int n = 0; n < 12; ++n) {
        const Triangle& t = mesh.faces[random.below(mesh.face_count())];
        mesh.positions[t[0]] += 0.9 * (mesh.positions[t[1]] - mesh.positions[t[0]]);
    }
    return mesh;
}

std::vector<SharpEdge> bends_of(const TriangleMesh& mesh, double angle) {
    return find_sharp_edges(mesh, face_normals(mesh), {.angle = angle, .weight = 1});
}

double stretch_of(const TriangleMesh& mesh, const Triangle& t) {
    return stretch(mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]);
}

std::size_t slivers_of(const TriangleMesh& mesh) {
    return std::count_if(mesh.faces.begin(), mesh.faces.end(),
                         [&](const Triangle& t) { return stretch_of(mesh, t) < kStretchFloor; });
}

double distance_to(const TriangleMesh& mesh, const std::vector<SharpEdge>& edges, const Vec3& p) {
    double least = std::numeric_limits<double>::infinity();
    for (const SharpEdge& e : edges)
        least = std::min(least, SegmentShape{{mesh.positions[e.a], mesh.positions[e.b]}}.closest(p).squared_distance);
    return std::sqrt(least);
}

TriangleMesh collapsed(TriangleMesh mesh, std::uint32_t gone, std::uint32_t kept) {
    for (Triangle& t : mesh.faces) std::replace(t.begin(), t.end(), gone, kept);
    mesh.faces.erase(std::remove_if(mesh.faces.begin(), mesh.faces.end(),
                                    [](const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; }),
                     mesh.faces.end());
    return mesh;
}

TriangleMesh flipped(TriangleMesh mesh, HalfEdge h, HalfEdge g) {
    const std::uint32_t a = origin(mesh, h), b = origin(mesh, g), c = origin(mesh, prev(h)), d = origin(mesh, prev(g));
    mesh.faces[face_of(h)] = {d, c, a};
    mesh.faces[face_of(g)] = {c, d, b};
    return mesh;
}

/// Whether the creases of `source` are still about, between points too.
bool keeps(const TriangleMesh& mesh, const TriangleMesh& source, const std::vector<SharpEdge>& creases) {
    const std::vector<SharpEdge> bends = bends_of(mesh, kCreaseBendShare * kAngle);
    return std::all_of(creases.begin(), creases.end(), [&](const SharpEdge& crease) {
        const Vec3 &a = source.positions[crease.a], &b = source.positions[crease.b];
        for (int n = 0; n <= 20; ++n) {
            if (distance_to(mesh, bends, a + (b - a) * (n / 20.0)) > 4.0 / 3 * kReach) return false;
        }
        return true;
    });
}

std::optional<SliverFace> sliver(const TriangleMesh& mesh, std::uint32_t f) {
    const double s = stretch_of(mesh, mesh.faces[f]);
    return s < kStretchFloor ? std::optional(SliverFace{.longest = 3 * f, .shortest = 3 * f, .stretch = s}) : std::nullopt;
}

/// Whether some flip or collapse of the face's edges, carried out, leaves fewer slivers and keeps the creases.
bool has_mend(const TriangleMesh& mesh, const CreaseMarks& marks, std::uint32_t f, const std::vector<SharpEdge>& creases) {
    for (const HalfEdge h : {3 * f, 3 * f + 1, 3 * f + 2}) {
        const std::uint32_t a = origin(mesh, h), b = origin(mesh, next(h));
        for (const TriangleMesh& after : {flipped(mesh, h, marks.twin(h)), collapsed(mesh, a, b), collapsed(mesh, b, a)}) {
            if (slivers_of(after) < slivers_of(mesh) && keeps(after, mesh, creases)) return true;
        }
    }
    return false;
}

TEST(HeldCreasesTest, AMendThatIsFoundKeepsTheCreasesWhenItIsCarriedOut) {
    int found = 0, held = 0;
    for (std::uint64_t seed = 1; seed <= 60; ++seed) {
        const TriangleMesh mesh = crumpled(seed);
        const FaceNormals normals = face_normals(mesh);
        const std::vector<SharpEdge> creases = bends_of(mesh, kAngle);
        CreaseMarks none(mesh), bends(mesh);
        bends.mark(bends_of(mesh, kCreaseBendShare * kAngle));
        const HeldCreases holds(mesh, bends, mesh, creases, kReach);
        // No creases of the mesh itself, so that the source's alone hold.
        const MendedMesh mended{mesh, none, normals, kAngle, nullptr, &holds};
        const MendedMesh free{mesh, none, normals, kAngle};
        for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
            const std::optional<SliverFace> face = sliver(mesh, f);
            if (!face || !std::all_of(normals.reliable.begin(), normals.reliable.end(), [](bool r) { return r; })) continue;
            const bool mends = least_mend(mended, *face).has_value();
            found += mends ? 1 : 0;
            held += !mends && least_mend(free, *face) ? 1 : 0;
            if (mends) {
                EXPECT_TRUE(has_mend(mesh, none, f, creases)) << "seed " << seed << ", face " << f;
            }
        }
    }
    EXPECT_GT(found, 5);
    EXPECT_GT(held, 5);
}

TEST(HeldCreasesTest, PointsLieAtTheNearestCreaseWithinReach) {
    Random random(5);
    int no = 0;
    for (std::uint64_t seed = 1; seed <= 30; ++seed) {
        const TriangleMesh source = noisy_cube(3, 0.3, seed);
        TriangleMesh mesh = source;
        for (Vec3& p : mesh.positions) p += 0.01 * Vec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
        const std::vector<SharpEdge> creases = bends_of(source, kAngle), bends = bends_of(mesh, kAngle);
        CreaseMarks marks(mesh);
        marks.mark(bends);
        const HeldCreases holds(mesh, marks, source, creases, kReach);
        for (HalfEdge h = 0; h < marks.half_edge_count(); ++h) {
            if (marks.edge_of(h) != h || !marks.marked(h)) continue;
            const Vec3 &a = mesh.positions[origin(mesh, h)], &b = mesh.positions[origin(mesh, next(h))];
            const SegmentShape here{{a, b}}, half{{a, (a + b) / 2}};
            // Half of a crease may stand for it where no point of the source lies nearest to the other half.
            bool expected = true, near_limit = false;
            for (const SharpEdge& crease : creases) {
                const Vec3 &u = source.positions[crease.a], &v = source.positions[crease.b];
                const double count = std::max(1.0, std::ceil((v - u).norm() / (2.0 / 3 * kReach)));
                for (int n = 0; n < count; ++n) {
                    const Vec3 p = u + (v - u) * ((n + 0.5) / count);
                    const double own = std::sqrt(here.closest(p).squared_distance), least = distance_to(mesh, bends, p);
                    if (own > least + 1e-12 || own > kReach) continue;
                    const double to_half = std::sqrt(half.closest(p).squared_distance);
                    expected = expected && to_half <= kReach;
                    // Nearest to an end that several creases share, it may lie at any of them.
                    near_limit = near_limit || own == std::sqrt(std::min((p - a).squaredNorm(), (p - b).squaredNorm()));
                }
            }
            if (near_limit) continue;
            EXPECT_EQ(holds.may_become(std::array{h}, std::array{half}), expected) << seed << ' ' << h;
            no += expected ? 0 : 1;
        }
    }
    EXPECT_GT(no, 20);
}

}  // namespace
}  // namespace vsplit::test

#include "simplify/edge_flipper.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <set>
#include <utility>

#include "tests/core/meshes.h"
#include "tests/core/polishing.h"
#include "vsplit/quality/stretch.h"

namespace vsplit::test {
namespace {

using Edge = std::pair<std::uint32_t, std::uint32_t>;

Edge ends(const Polishing& p, HalfEdge h) { return std::minmax({p.mesh.origin(h), p.mesh.target(h)}); }

std::set<Edge> edge_set(const Polishing& p, bool creases_only = false) {
    std::set<Edge> all;
    for (const HalfEdge h : p.edges()) {
        if (!creases_only || p.mesh.is_crease(h)) all.insert(ends(p, h));
    }
    return all;
}

double length(const Polishing& p, const Edge& edge) {
    return (p.mesh.position(edge.first) - p.mesh.position(edge.second)).norm();
}

double least_stretch(const Polishing& p) {
    double least = 1;
    for (const HalfEdge h : p.edges()) least = std::min(least, p.measured(face_of(h)).stretch);
    return least;
}

void flip_all(Polishing& p, const PolishLimits& limits) { EdgeFlipper(p.mesh, p.state, p.log, {}, limits).flip_all(); }

/// Edges of the mesh that were not there before.
std::set<Edge> fresh(const Polishing& p, const std::set<Edge>& before) {
    std::set<Edge> result;
    for (const Edge& edge : edge_set(p)) {
        if (!before.contains(edge)) result.insert(edge);
    }
    return result;
}

/// A flat body: above the ridge left-right, `height` over the ridge front-back below, which a vertex on either side splits off
/// from the rim. The simplifier numbers vertices its own way.
struct FlatBody {
    Polishing p;
    std::uint32_t left = 0, right = 0, front = 0, back = 0;

    explicit FlatBody(double height) : p(mesh(height), 0) {
        left = at(0);
        right = at(1);
        front = at(2);
        back = at(3);
    }

    static TriangleMesh mesh(double height) {
        return {{{-2, 0, height}, {2, 0, height}, {0, -1, 0}, {0, 1, 0}, {-0.6, 0, 0}, {0.6, 0, 0}},
                {{0, 1, 3}, {1, 0, 2}, {2, 3, 5}, {3, 2, 4}, {3, 1, 5}, {1, 2, 5}, {2, 0, 4}, {0, 3, 4}}};
    }

    [[nodiscard]] HalfEdge ridge_below() const {
        HalfEdge found = kNone;
        p.mesh.for_each_outgoing(front, [&](HalfEdge h) { found = p.mesh.target(h) == back ? h : found; });
        return found;
    }

    /// Anew, after the test turned an edge itself.
    void measure() {
        for (std::uint32_t f = 0; f < p.state.faces.size(); ++f) p.state.faces[f] = p.measured(f);
    }

private:
    [[nodiscard]] std::uint32_t at(std::uint32_t number) const {
        const auto& all = p.input.mesh.positions;
        const Vec3 place = mesh(0).positions[number];
        std::uint32_t nearest = 0;
        for (std::uint32_t v = 0; v < all.size(); ++v) {
            if ((all[v] - place).head<2>().norm() < (all[nearest] - place).head<2>().norm()) nearest = v;
        }
        return nearest;
    }
};

TEST(EdgeFlipperTest, AFlatGridGetsBetterAndKeepsItsShapeExactly) {
    for (const std::uint64_t seed : {1U, 2U, 3U}) {
        const TriangleMesh source = jittered_cube(8, 0.15, seed);
        Polishing p(source, 1e-3);
        const std::set<Edge> before = edge_set(p);
        const double least = least_stretch(p);
        flip_all(p, p.limits());
        EXPECT_GT(fresh(p, before).size(), 50U);
        EXPECT_GT(least_stretch(p), least);
        const TriangleMesh after = p.now();
        EXPECT_EQ(after.positions, p.input.mesh.positions);
        EXPECT_NEAR(surface_area(after), 6, 1e-12);
        EXPECT_NEAR(enclosed_volume(after), 1, 1e-12);
        for (const Triangle& t : after.faces) {
            bool on_a_side = false;
            for (int axis = 0; axis < 3; ++axis) {
                const double x = after.positions[t[0]][axis];
                on_a_side |= (x == 0 || x == 1) && after.positions[t[1]][axis] == x && after.positions[t[2]][axis] == x;
            }
            EXPECT_TRUE(on_a_side);
        }
        expect_consistent(p);
    }
}

/// What a flip of h would raise the smaller stretch by, where the quad is flat and convex; else nothing.
double flat_gain(const Polishing& p, HalfEdge h) {
    const HalfEdge g = p.mesh.twin(h);
    const Vec3& a = p.mesh.position(p.mesh.origin(h));
    const Vec3& b = p.mesh.position(p.mesh.target(h));
    const Vec3& c = p.mesh.position(p.mesh.origin(prev(h)));
    const Vec3& d = p.mesh.position(p.mesh.origin(prev(g)));
    const Vec3 normal = (b - a).cross(c - a).normalized();
    if ((c - d).cross(a - d).normalized().dot(normal) < 0.999 || (d - c).cross(b - c).normalized().dot(normal) < 0.999) return 0;
    return std::min(stretch(d, c, a), stretch(c, d, b)) - std::min(stretch(a, b, c), stretch(b, a, d));
}

TEST(EdgeFlipperTest, LeavesNoFlipThatWouldGain) {
    Polishing p(jittered_cube(9, 0.15, 4), 1e-3);
    const auto gainful = [&p] {
        int count = 0;
        for (const HalfEdge h : p.edges()) {
            const HalfEdge g = p.mesh.twin(h);
            const bool good = std::min(p.measured(face_of(h)).stretch, p.measured(face_of(g)).stretch) > 0.95;
            const bool thin = std::min(p.mesh.valence(p.mesh.origin(h)), p.mesh.valence(p.mesh.origin(g))) <= 3;
            if (p.mesh.is_crease(h) || good || thin || p.joined(p.mesh.origin(prev(h)), p.mesh.origin(prev(g)))) continue;
            count += flat_gain(p, h) > kLeastGain + 1e-9 ? 1 : 0;
        }
        return count;
    };
    EXPECT_GT(gainful(), 50);
    flip_all(p, p.limits());
    EXPECT_EQ(gainful(), 0);
}

TEST(EdgeFlipperTest, ACreaseIsNeverFlipped) {
    const TriangleMesh source = jittered_cube(8, 0.15, 5);
    Polishing free(source, 1e-3);
    const std::set<Edge> before = edge_set(free);
    const std::set<Edge> creases = edge_set(free, true);
    EXPECT_EQ(creases.size(), 12U * 8);
    flip_all(free, free.limits());
    EXPECT_EQ(edge_set(free, true), creases);

    // What goes in the free run stays once it is marked.
    Polishing marked(source, 1e-3);
    const std::set<Edge> left = edge_set(free);
    std::set<Edge> kept;
    for (const HalfEdge h : marked.edges()) {
        if (left.contains(ends(marked, h))) continue;
        marked.mesh.mark_crease(h);
        kept.insert(ends(marked, h));
    }
    EXPECT_GT(kept.size(), 50U);
    const std::set<Edge> all_marked = edge_set(marked, true);
    flip_all(marked, marked.limits());
    EXPECT_EQ(edge_set(marked, true), all_marked);
    expect_consistent(marked);
}

TEST(EdgeFlipperTest, NoEdgeIsMadeThatIsThere) {
    for (const bool there : {true, false}) {
        FlatBody body(0.01);
        Polishing& p = body.p;
        PolishLimits limits = p.limits();
        limits.tolerance = 1;
        there ? p.mesh.mark_crease(body.ridge_below()) : p.mesh.flip(body.ridge_below());
        body.measure();
        flip_all(p, limits);
        EXPECT_EQ(p.joined(body.left, body.right), there);
        EXPECT_TRUE(p.joined(body.front, body.back));
        expect_consistent(p);
    }
}

TEST(EdgeFlipperTest, TheSurfaceMovesWithinTheTolerance) {
    for (const double share : {0.9, 1.1}) {
        const double height = 0.05;
        FlatBody body(height);
        body.p.mesh.flip(body.ridge_below());
        body.measure();
        PolishLimits limits = body.p.limits();
        limits.tolerance = share * height;
        flip_all(body.p, limits);
        EXPECT_EQ(body.p.joined(body.left, body.right), share < 1) << "the diagonals are " << height << " apart";
    }
}

TEST(EdgeFlipperTest, KeepsCurvedAndRoughMeshesManifold) {
    for (const TriangleMesh& source :
         {torus(14, 3), torus(40, 9), bumpy_sphere(3, 0.05, 6), noisy_cube(7, 0.3, 7), sliver_cylinder(24, 0.2), cube_frame()}) {
        Polishing p(source, 1);
        const std::set<Edge> creases = edge_set(p, true);
        flip_all(p, p.limits());
        EXPECT_EQ(edge_set(p, true), creases);
        expect_consistent(p);
    }
}

TEST(EdgeFlipperTest, RespectsSize) {
    const TriangleMesh source = jittered_cube(8, 0.15, 8);
    const double bound = 1.3 / 8;
    const auto longest_fresh = [&](double max_size) {
        Polishing p(source, 1e-3);
        const std::set<Edge> before = edge_set(p);
        PolishLimits limits = p.limits();
        limits.max_size = max_size;
        flip_all(p, limits);
        double longest = 0;
        for (const Edge& edge : fresh(p, before)) longest = std::max(longest, length(p, edge));
        EXPECT_GT(longest, 0);
        return longest;
    };
    EXPECT_GT(longest_fresh(std::numeric_limits<double>::infinity()), bound);
    EXPECT_LE(longest_fresh(bound), bound);
}

TEST(EdgeFlipperTest, RespectsValence) {
    const TriangleMesh source = jittered_cube(10, 0.15, 9);
    const auto largest_grown = [&](std::uint32_t max_valence) {
        Polishing p(source, 1e-3);
        const HalfEdgeMesh before = p.mesh;
        PolishLimits limits = p.limits();
        limits.max_valence = max_valence;
        flip_all(p, limits);
        std::uint32_t largest = 0;
        for (std::uint32_t v = 0; v < before.vertex_count(); ++v) {
            if (p.mesh.valence(v) > before.valence(v)) largest = std::max(largest, p.mesh.valence(v));
        }
        return largest;
    };
    EXPECT_GT(largest_grown(100), 7U);
    EXPECT_EQ(largest_grown(7), 7U);
    EXPECT_LE(largest_grown(6), 6U);
}

TEST(EdgeFlipperTest, AroundAVertexItNamesEveryFaceThatChanged) {
    Polishing p(jittered_cube(8, 0.15, 10), 1e-3);
    EdgeFlipper flipper(p.mesh, p.state, p.log, {}, p.limits());
    std::size_t flipped = 0;
    for (std::uint32_t v = 0; v < p.mesh.vertex_count(); ++v) {
        const std::vector<Triangle> before = p.now().faces;
        const double least = least_stretch(p);
        flipper.flip_around(v);
        const std::vector<Triangle> after = p.now().faces;
        const std::set<std::uint32_t> named(flipper.changed_faces().begin(), flipper.changed_faces().end());
        for (std::uint32_t f = 0; f < before.size(); ++f) {
            if (before[f] != after[f]) {
                EXPECT_TRUE(named.contains(f)) << "face " << f << " around " << v;
            }
        }
        EXPECT_GE(least_stretch(p), least);
        flipped += named.size();
    }
    EXPECT_GT(flipped, 100U);
    expect_consistent(p);
}

}  // namespace
}  // namespace vsplit::test

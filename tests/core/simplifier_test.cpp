#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "base/thread_limit.h"
#include "mesh/cap_boundaries.h"
#include "simplify/collapse_log.h"
#include "simplify/edge_evaluator.h"
#include "simplify/edge_queue.h"
#include "simplify/fan_shape.h"
#include "simplify/polish.h"
#include "simplify/simplify.h"
#include "tests/core/meshes.h"
#include "tests/core/polishing.h"
#include "tests/core/random.h"
#include "vsplit/mesh/inspect.h"
#include "vsplit/mrr/progressive_mesh.h"
#include "vsplit/quality/stretch.h"
#include "vsplit/subdivide/subdivide.h"

namespace vsplit {
namespace {

ControlPolicy control_policy(const TriangleMesh& mesh) {
    ControlPolicy policy;
    policy.min_stretch = 0.25;
    policy.max_size = 0.7 * bounding_box(mesh).diagonal();
    policy.max_valence = 9;
    policy.size_unit = policy.max_size;
    return policy;
}

std::vector<HalfEdge> live_edges(const HalfEdgeMesh& mesh) {
    std::vector<HalfEdge> edges;
    for (HalfEdge h = 0; h < mesh.half_edge_count(); ++h) {
        if (!mesh.removed(h) && mesh.edge_of(h) == h) edges.push_back(h);
    }
    return edges;
}

/// The paper's loop taken literally: evaluate every edge, collapse the best, forget everything, begin again.
template <class Policy>
class LiteralSimplifier {
public:
    LiteralSimplifier(const SimplifyInput& input, const Policy& policy)
        : input_(input), policy_(policy), mesh_(input.mesh, input.ghosts), state_(initial_state(input_)) {}

    MultiresMesh run() {
        if constexpr (requires { policy_.max_valence; }) mend_first();
        for (int phase = policy_.two_phases() ? 1 : 2; phase <= 2; ++phase) {
            policy_.enter_phase(phase);
            while (mesh_.live_faces() >= input_.faces_min + 2 && collapse_best()) {
            }
        }
        return log_.build(mesh_);
    }

private:
    /// As the strict mode does where vertices have too many edges; tested on its own.
    void mend_first() {
        PolishLimits limits{.centre = input_.centre, .tolerance = input_.tolerance, .max_size = policy_.max_size};
        limits.max_valence = policy_.max_valence;
        limits.bounds = policy_;
        for (const SharpEdge& crease : input_.creases) {
            mesh_.for_each_outgoing(crease.a, [&](HalfEdge h) {
                if (mesh_.target(h) == crease.b) mesh_.mark_crease(h);
            });
        }
        Polisher(mesh_, state_, log_, {}, limits).mend(8, false, ExecutionContext());
    }

    bool collapse_best() {
        EdgeEvaluator<Policy> evaluator(mesh_, state_, policy_, input_);
        std::optional<HalfEdge> best;
        Evaluation best_evaluation;
        for (const HalfEdge edge : live_edges(mesh_)) {
            const Evaluation evaluation = evaluator.evaluate(edge);
            if (evaluation.verdict != Evaluation::Verdict::kValid) continue;
            if (best && evaluation.priority <= best_evaluation.priority) continue;
            best = edge;
            best_evaluation = evaluation;
        }
        if (!best) return false;
        collapse(*best, evaluator);
        return true;
    }

    void collapse(HalfEdge edge, EdgeEvaluator<Policy>& evaluator) {
        const EdgeStar star = mesh_.star(edge);
        const Evaluation evaluation = evaluator.evaluate(edge);
        const Fan& fan = evaluator.fan();
        log_.record(mesh_, star, evaluation.position);
        state_.quadrics[mesh_.origin(star.ij)] += state_.quadrics[mesh_.origin(star.ji)];
        state_.border.join(mesh_.origin(star.ij), mesh_.origin(star.ji));
        mesh_.collapse(star, evaluation.position);
        for (std::size_t t = 0; t < fan.size(); ++t) {
            state_.faces[fan.face(t)] = {fan.normal(t), fan.stretch(t), fan.face_size(t)};
        }
    }

    SimplifyInput input_;
    Policy policy_;
    HalfEdgeMesh mesh_;
    LocalState state_;
    CollapseLog log_;
};

TEST(SimplifierTest, CollapsesInExactlyTheOrderOfTheLiteralAlgorithm) {
    const ExecutionContext context;
    for (const TriangleMesh& mesh :
         {test::icosphere(2), test::torus(16, 10), test::bumpy_sphere(2, 0.05, 3), test::plate_with_holes(2),
          test::sliver_cylinder(24, 6), test::joined(test::cube_frame(), test::icosphere(1), Vec3(20, 0, 0)),
          test::holed_square(8, 2), test::open_cylinder(24, 5), test::hemisphere(20, 6),
          test::joined(test::square(5), test::cube_frame(), Vec3(0, 0, 3))}) {
        const SimplifyInput input = test::simplify_input(mesh, 0.05);
        const auto improved = simplify(input, ImprovePolicy{}, context);
        ASSERT_TRUE(improved);
        EXPECT_GT(improved->levels(), 0U);
        EXPECT_EQ(*improved, LiteralSimplifier<ImprovePolicy>(input, ImprovePolicy{}).run());
        const auto controlled = simplify(input, control_policy(mesh), context);
        ASSERT_TRUE(controlled);
        EXPECT_EQ(*controlled, LiteralSimplifier<ControlPolicy>(input, control_policy(mesh)).run());
    }
}

/// The faces around both ends of an edge, found by looking at all faces.
std::vector<Triangle> faces_at(const TriangleMesh& mesh, std::uint32_t i, std::uint32_t j) {
    std::vector<Triangle> around;
    for (const Triangle& t : mesh.faces) {
        if (std::any_of(t.begin(), t.end(), [&](std::uint32_t v) { return v == i || v == j; })) around.push_back(t);
    }
    return around;
}

struct ByHand {
    double q_before = 0, q_after = 0, faces_before = 0, size_before = 0, inverse_size_before = 0, faces_after = 0, sum_after = 0,
           min_after = 2;
};

/// Everything in Eqs. 7 to 9, from the definitions.
ByHand by_hand(const TriangleMesh& mesh, std::uint32_t i, std::uint32_t j, const Vec3& k) {
    ByHand result;
    double sum_before = 0;
    double min_before = 2;
    for (const Triangle& t : faces_at(mesh, i, j)) {
        std::array<Vec3, 3> p{mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]};
        const double before = stretch(p[0], p[1], p[2]);
        sum_before += before;
        min_before = std::min(min_before, before);
        result.faces_before += 1;
        result.size_before += face_size(p[0], p[1], p[2]);
        result.inverse_size_before += 1 / face_size(p[0], p[1], p[2]);
        int ends = 0;
        for (int c = 0; c < 3; ++c) {
            if (t[c] != i && t[c] != j) continue;
            p[c] = k;
            ++ends;
        }
        if (ends == 2) continue;
        const double after = stretch(p[0], p[1], p[2]);
        result.sum_after += after;
        result.min_after = std::min(result.min_after, after);
        result.faces_after += 1;
    }
    result.q_before = min_before * sum_before / result.faces_before;
    result.q_after = result.min_after * result.sum_after / result.faces_after;
    return result;
}

/// Compares every valid edge of `source`; how many there were, and how many of them with an end on a boundary.
std::pair<int, int> expect_papers_priorities(const TriangleMesh& source) {
    const SimplifyInput input = test::simplify_input(source, 0.2);
    TriangleMesh mesh = input.mesh;
    std::erase_if(mesh.faces, [&](const Triangle& face) { return touches_ghost(face, input.ghosts); });
    const HalfEdgeMesh half_edges(input.mesh, input.ghosts);
    const ImprovePolicy improve_policy;
    ControlPolicy policy = control_policy(source);
    policy.min_stretch = 0;
    const LocalState state = initial_state(input);
    EdgeEvaluator<ImprovePolicy> improving(half_edges, state, improve_policy, input);
    EdgeEvaluator<ControlPolicy> controlling(half_edges, state, policy, input);
    std::pair<int, int> valid{0, 0};
    for (const HalfEdge h : live_edges(half_edges)) {
        const std::uint32_t i = half_edges.origin(h);
        const std::uint32_t j = half_edges.target(h);
        const Evaluation improved = improving.evaluate(h);
        if (improved.verdict == Evaluation::Verdict::kValid) {
            const ByHand hand = by_hand(mesh, i, j, improved.position);
            const double rho = hand.faces_before / hand.size_before * hand.q_after / hand.q_before;
            EXPECT_NEAR(improved.priority, rho, 1e-9 * rho);
            ++valid.first;
            valid.second += state.border.ghost_beside(i) != kNone || state.border.ghost_beside(j) != kNone ? 1 : 0;
        }
        const Evaluation controlled = controlling.evaluate(h);
        if (controlled.verdict != Evaluation::Verdict::kValid) continue;
        const ByHand hand = by_hand(mesh, i, j, controlled.position);
        const double rho = hand.inverse_size_before * policy.max_size * hand.min_after * hand.sum_after /
                           (2 * std::max(hand.faces_after - 1, 1.0));
        EXPECT_NEAR(controlled.priority, rho, 1e-9 * rho);
    }
    return valid;
}

TEST(EdgeEvaluatorTest, PrioritiesAreThePapersEquations) {
    EXPECT_GT(expect_papers_priorities(test::bumpy_sphere(2, 0.05, 9)).first, 100);
}

TEST(EdgeEvaluatorTest, AtABoundaryOnlyWhatIsSeenCounts) {
    for (const TriangleMesh& source : {test::holed_square(8, 2), test::hemisphere(20, 6), test::open_cylinder(12, 1)}) {
        EXPECT_GT(expect_papers_priorities(source).second, 10);
    }
}

TEST(EdgeEvaluatorTest, LinkConditionIsThatOfTheDefinition) {
    // A double cone over a triangle: collapsing an edge of the triangle would pinch it, as would any of a tetrahedron.
    TriangleMesh cones;
    cones.positions = {Vec3(1, 0, 0), Vec3(-0.5, 0.9, 0), Vec3(-0.5, -0.9, 0), Vec3(0, 0, 1), Vec3(0, 0, -1)};
    cones.faces = {{0, 1, 3}, {1, 2, 3}, {2, 0, 3}, {1, 0, 4}, {2, 1, 4}, {0, 2, 4}};
    for (const TriangleMesh& mesh : {cones, test::tetrahedron(), test::torus(3, 3), test::cube()}) {
        const SimplifyInput input = test::simplify_input(mesh, 1e6);
        const HalfEdgeMesh half_edges(input.mesh);
        const LocalState state = initial_state(input);
        const ImprovePolicy policy;
        EdgeEvaluator<ImprovePolicy> evaluator(half_edges, state, policy, input);
        for (const HalfEdge h : live_edges(half_edges)) {
            std::array<std::set<std::uint32_t>, 2> neighbours;
            for (const int end : {0, 1}) {
                const std::uint32_t v = end == 0 ? half_edges.origin(h) : half_edges.target(h);
                half_edges.for_each_outgoing(v, [&](HalfEdge out) { neighbours[end].insert(half_edges.target(out)); });
            }
            std::vector<std::uint32_t> common;
            std::set_intersection(neighbours[0].begin(), neighbours[0].end(), neighbours[1].begin(), neighbours[1].end(),
                                  std::back_inserter(common));
            const bool tetrahedron = input.mesh.faces.size() == 4;
            if (common.size() == 2 && !tetrahedron) continue;
            EXPECT_NE(evaluator.evaluate(h).verdict, Evaluation::Verdict::kValid);
        }
    }
}

TEST(EdgeQueueTest, BehavesLikeASortedMap) {
    test::Random random(21);
    constexpr std::uint32_t kEdges = 3000;  // three levels of matches
    constexpr HalfEdge kFirst = 300;
    EdgeQueue queue(kFirst, kFirst + kEdges);
    std::map<HalfEdge, double> reference;
    std::set<HalfEdge> aside;
    const auto best = [&] {
        return *std::min_element(reference.begin(), reference.end(), [](const auto& l, const auto& r) {
            return l.second != r.second ? l.second > r.second : l.first < r.first;
        });
    };
    for (int step = 0; step < 20000; ++step) {
        const HalfEdge edge = kFirst + random.below(step < 200 ? 2 : step < 10000 ? 60 : kEdges);
        reference.erase(edge);
        aside.erase(edge);
        if (random.below(3) == 0) {
            queue.erase(edge);
        } else if (random.below(step < 5000 ? 2 : 4) == 0) {
            queue.set_aside(edge);
            aside.insert(edge);
        } else {
            const double priority = random.below(50);  // few values, so that ties happen
            queue.set(edge, priority);
            reference[edge] = priority;
        }
        ASSERT_EQ(queue.is_aside(edge), aside.contains(edge));
        if (reference.empty()) {
            ASSERT_EQ(queue.top(), kNone);
            continue;
        }
        ASSERT_EQ(queue.top(), best().first);
        ASSERT_EQ(queue.priority(best().first), best().second);
    }
}

TEST(SimplifierTest, SameBytesForAnyNumberOfThreads) {
    const SimplifyInput input = test::simplify_input(test::bumpy_sphere(4, 0.02, 4), 0.01);
    const ExecutionContext one({}, 1);
    const ExecutionContext four({}, 4);
    const auto left = simplify(input, ImprovePolicy{}, one);
    const auto right = simplify(input, ImprovePolicy{}, four);
    ASSERT_TRUE(left);
    ASSERT_TRUE(right);
    EXPECT_EQ(*left, *right);
}

/// Large enough for several parts, on the way there too.
TEST(SimplifierTest, PartsGiveTheSameBytesForAnyNumberOfThreads) {
    for (const TriangleMesh& mesh :
         {test::bumpy_sphere(6, 0.002, 4), test::punctured(test::torus(250, 100), {0, 20000, 40000})}) {
        SimplifyInput input = test::simplify_input(mesh, 0.01);
        input.faces = input.faces_min = 8000;
        const ExecutionContext one({}, 1), many;
        const auto left = with_thread_limit(one, [&] { return simplify(input, Extended<ImprovePolicy>{}, one); });
        const auto right = with_thread_limit(many, [&] { return simplify(input, Extended<ImprovePolicy>{}, many); });
        ASSERT_TRUE(left && right);
        EXPECT_TRUE(*left == *right);
        EXPECT_GT(left->records.flips().size(), 100U);
        EXPECT_GT(left->records.moves().size(), 100U);
        for (const double share : {0.0, 0.3, 0.7, 1.0}) {
            const MeshReport report =
                inspect(mesh_at(*left, static_cast<std::size_t>(share * static_cast<double>(left->levels()))));
            EXPECT_TRUE(require_manifold(report)) << share;
            EXPECT_EQ(report.components, 1U);
        }
    }
}

TEST(SimplifierTest, SameBytesWithAnyKindOfVector) {
    const ExecutionContext context;
    for (const TriangleMesh& mesh : {test::bumpy_sphere(3, 0.02, 4), test::holed_square(12, 2)}) {
        const SimplifyInput input = test::simplify_input(mesh, 0.02);
        const auto expected = simplify(input, ImprovePolicy{}, context),
                   extended = simplify(input, Extended<ImprovePolicy>{}, context);
        ASSERT_TRUE(expected && extended);
        for (const std::int64_t path : simd_paths()) {
            SCOPED_TRACE(simd_path_name(path));
            use_simd_path(path);
            const auto found = simplify(input, ImprovePolicy{}, context),
                       also = simplify(input, Extended<ImprovePolicy>{}, context);
            use_simd_path(0);
            ASSERT_TRUE(found && also);
            EXPECT_EQ(*found, *expected);
            EXPECT_EQ(*also, *extended);
        }
    }
}

TEST(SimplifierTest, KeepsEveryCollapseWithinTolerance) {
    // With a tolerance of nothing a closed sphere, curved everywhere, cannot lose a vertex; a cube cut fine can, down to its
    // corners.
    const ExecutionContext context;
    const auto sphere = simplify(test::simplify_input(test::icosphere(3), 1e-12), ImprovePolicy{}, context);
    ASSERT_TRUE(sphere);
    EXPECT_EQ(sphere->levels(), 0U);
    const auto fine = subdivide_one_to_four(test::cube(), 3, 10000, context);
    ASSERT_TRUE(fine);
    const auto box = simplify(test::simplify_input(fine->mesh, 1e-7), ImprovePolicy{}, context);
    ASSERT_TRUE(box);
    EXPECT_LT(box->faces_min(), fine->mesh.face_count() / 4);
    EXPECT_NEAR(enclosed_volume(box->base), 1, 1e-5);
}

TEST(SimplifierTest, StopsAtFacesMinAndWhenCancelled) {
    SimplifyInput input = test::simplify_input(test::icosphere(3), 1);
    input.faces_min = 301;
    const ExecutionContext context;
    const auto coarse = simplify(input, ImprovePolicy{}, context);
    ASSERT_TRUE(coarse);
    EXPECT_EQ(coarse->faces_min(), 302U);
    ExecutionContext stopped;
    stopped.cancel();
    EXPECT_EQ(simplify(input, ImprovePolicy{}, stopped).error().cause, Cause::kCancelled);
}

TEST(SimplifierTest, CancelIsObeyedFromWithinAReport) {
    ExecutionContext* self = nullptr;
    int reports = 0;
    ExecutionContext context([&](const Progress& progress) {
        if (progress.stage == "simplify" && ++reports == 2) self->cancel();
    });
    self = &context;
    const auto stopped = simplify(test::simplify_input(test::icosphere(6), 0.2), ImprovePolicy{}, context);
    ASSERT_FALSE(stopped);
    EXPECT_EQ(stopped.error().cause, Cause::kCancelled);
    EXPECT_EQ(reports, 2) << "nothing is reported after the cancel";
}

}  // namespace
}  // namespace vsplit

#include "quality/deviation_search.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "quality/convex_piece.h"

// The distance to ONE shape S of the other side (a convex set) is a convex function: over a convex piece it is largest at a
// corner. The distance to all of them is at most that, so a piece whose corners are near one S is near everywhere. Besides, no
// distance changes faster than its point moves. A piece that neither bound settles is cut where S ends, if it reaches beyond (so
// that over flat regions each part lies over one shape, and is settled at once), else in halves.

namespace vsplit {
namespace {

constexpr std::size_t kChunk = 64;           ///< elements or pieces that one thread looks at in a row
constexpr std::size_t kBatch = 64 * kChunk;  ///< between looks at the common lower bound, and at cancel()
constexpr std::uint64_t kFirstSteps = 24;    ///< looks spent on each piece a round; doubled every round
constexpr std::uint64_t kMostSteps = 4096;

/// A look at so many shapes counts as another step of the budget: where boxes tell needles apart badly a look is dear.
constexpr std::uint32_t kTestsAStep = 256;

/// Cuts where a shape ends must take off or leave at least this share of the piece's radius; halving serves slices better.
constexpr double kLeastSlice = 0.02;

/// Every so many cuts a piece is halved whatever it lies over, so that its radius shrinks.
constexpr std::uint32_t kHalvedEvery = 4;

struct Piece {
    ConvexPiece shape;
    double upper = std::numeric_limits<double>::infinity();  ///< no point of it is further
    std::uint32_t near = 0;                                  ///< an element of the other side to try first
    std::uint32_t cuts = 0;
};

/// The bounds so far, and what is still to be looked at.
struct Findings {
    double lower = 0;
    Vec3 at = Vec3::Zero();
    bool found = false;  ///< `at` is a point of the shapes
    double settled = 0;  ///< largest bound of what need not be looked at again
    std::uint64_t steps = 0;
    std::vector<Piece> open;

    void see(double distance, const Vec3& p) {
        if (found && distance <= lower) return;
        found = true;
        lower = distance;
        at = p;
    }

    void add(const Findings& other) {
        if (other.found) see(other.lower, other.at);
        settled = std::max(settled, other.settled);
        steps += other.steps;
        open.insert(open.end(), other.open.begin(), other.open.end());
    }
};

template <class Shape>
class Search {
public:
    using Hit = typename ShapeIndex<Shape>::Hit;
    using Element = std::array<std::uint32_t, Shape::kCorners>;

    Search(const ShapesOf<Shape>& from, const ShapeIndex<Shape>& to, const SearchLimits& limits, const ExecutionContext& context,
           const SearchProgress& progress)
        : from_(from), to_(to), limits_(limits), context_(context), progress_(progress) {}

    [[nodiscard]] Expected<DirectedDeviation> run() {
        if (!look_at_vertices() || !look_at_elements() || !refine()) return ExecutionContext::cancelled_error();
        double upper = std::max(all_.settled, all_.lower);
        for (const Piece& piece : all_.open) upper = std::max(upper, piece.upper);
        return DirectedDeviation{all_.lower, upper, all_.at};
    }

private:
    /// Bounds up to here are near enough.
    [[nodiscard]] double enough(double lower) const {
        return lower + std::max(limits_.absolute_error, limits_.relative_error * lower);
    }

    /// Runs work(begin, end, found) over 0..count in chunks, each with the lower bound of the batches before, and adds up what
    /// they found in their order. False when cancelled.
    template <class Work>
    bool in_batches(std::size_t count, double progress_from, double progress_to, const Work& work) {
        for (std::size_t begin = 0; begin < count; begin += kBatch) {
            if (context_.cancelled()) return false;
            progress_(progress_from + (progress_to - progress_from) * static_cast<double>(begin) / static_cast<double>(count));
            const std::size_t end = std::min(count, begin + kBatch);
            std::vector<Findings> found((end - begin + kChunk - 1) / kChunk);
            tbb::parallel_for(std::size_t{0}, found.size(), [&](std::size_t chunk) {
                if (context_.cancelled()) return;
                found[chunk].lower = all_.lower;
                found[chunk].found = all_.found;
                found[chunk].at = all_.at;
                const std::size_t first = begin + chunk * kChunk;
                work(first, std::min(end, first + kChunk), found[chunk]);
            });
            for (const Findings& chunk : found) all_.add(chunk);
        }
        return !context_.cancelled();
    }

    bool look_at_vertices() {
        std::vector<bool> used(from_.positions.size(), false);
        for (const Element& element : from_.elements) {
            for (const std::uint32_t v : element) used[v] = true;
        }
        vertices_.resize(from_.positions.size());
        return in_batches(vertices_.size(), 0, 0.3, [&](std::size_t begin, std::size_t end, Findings& found) {
            std::uint32_t near = 0;
            for (std::size_t v = begin; v < end; ++v) {
                if (!used[v]) continue;
                const Hit hit = nearest(from_.positions[v], near);
                near = hit.element;
                vertices_[v] = {std::sqrt(hit.squared_distance), near};
                found.see(vertices_[v].distance, from_.positions[v]);
            }
        });
    }

    bool look_at_elements() {
        return in_batches(from_.elements.size(), 0.3, 0.8, [&](std::size_t begin, std::size_t end, Findings& found) {
            const std::uint64_t steps = is_spent() ? 0 : kFirstSteps;
            for (std::size_t e = begin; e < end; ++e) {
                Piece piece = piece_of(from_.elements[e], enough(found.lower));
                if (piece.upper <= enough(found.lower)) {
                    found.settled = std::max(found.settled, piece.upper);
                } else {
                    look_at(std::move(piece), steps, found);
                }
            }
        });
    }

    /// Rounds over what is open, the worst first, until nothing is or the budget ends.
    bool refine() {
        std::uint64_t steps = kFirstSteps;
        for (double from = 0.8; !all_.open.empty() && !is_spent(); from = (from + 1) / 2) {
            std::vector<Piece> pieces;
            pieces.swap(all_.open);
            std::stable_sort(pieces.begin(), pieces.end(), [](const Piece& l, const Piece& r) { return l.upper > r.upper; });
            const std::uint64_t share = (limits_.evaluations - all_.steps) / pieces.size() + 1;
            steps = std::min({2 * steps, kMostSteps, share});
            const bool whole =
                in_batches(pieces.size(), from, (from + 1) / 2, [&](std::size_t begin, std::size_t end, Findings& found) {
                    const std::uint64_t most = is_spent() ? 0 : steps;
                    for (std::size_t i = begin; i < end; ++i) look_at(std::move(pieces[i]), most, found);
                });
            if (!whole) return false;
        }
        return true;
    }

    [[nodiscard]] bool is_spent() const { return all_.steps >= limits_.evaluations; }

    [[nodiscard]] Hit nearest(const Vec3& p, std::uint32_t near) const {
        return to_.closest(p, to_.shape(near).closest(p).squared_distance);
    }

    /// A face or edge, bounded by what is known of its corners; tries no longer than until the bound is enough.
    [[nodiscard]] Piece piece_of(const Element& element, double enough) const {
        std::array<Vec3, Shape::kCorners> corners;
        double furthest = 0;
        double longest = 0;
        for (std::size_t i = 0; i < Shape::kCorners; ++i) {
            corners[i] = from_.positions[element[i]];
            furthest = std::max(furthest, vertices_[element[i]].distance);
            for (std::size_t j = 0; j < i; ++j) longest = std::max(longest, (corners[i] - corners[j]).norm());
        }
        // No point of a triangle is further than this from its nearest corner; of a segment even less.
        constexpr double kToCorner = 0.57735026918962584;
        Piece piece{ConvexPiece(corners), furthest + kToCorner * longest, vertices_[element[0]].near, 0};
        for (std::size_t i = 0; i < Shape::kCorners && piece.upper > enough; ++i) bound_by(vertices_[element[i]].near, piece);
        return piece;
    }

    /// The piece's distance to one shape. \return the corner furthest from it.
    Vec3 bound_by(std::uint32_t element, Piece& piece) const {
        const auto& shape = to_.shape(element);
        double worst = -1;
        Vec3 where = Vec3::Zero();
        for (const Vec3& p : piece.shape.corners()) {
            const double squared = shape.closest(p).squared_distance;
            if (squared <= worst) continue;
            worst = squared;
            where = p;
        }
        const double bound = std::sqrt(worst);
        if (bound < piece.upper) {
            piece.upper = bound;
            piece.near = element;
        }
        return where;
    }

    /// Settles the piece and its parts, or leaves what is not after so many steps open.
    void look_at(Piece piece, std::uint64_t steps, Findings& found) const {
        std::vector<Piece> stack;
        stack.push_back(std::move(piece));
        while (!stack.empty()) {
            Piece top = std::move(stack.back());
            stack.pop_back();
            if (top.upper <= enough(found.lower)) {
                found.settled = std::max(found.settled, top.upper);
            } else if (steps == 0) {
                found.open.push_back(std::move(top));
            } else {
                --steps;
                ++found.steps;
                step(std::move(top), stack, found);
            }
        }
    }

    /// Betters the bound of a piece, and cuts it where that is not enough.
    void step(Piece piece, std::vector<Piece>& stack, Findings& found) const {
        Vec3 corner = bound_by(piece.near, piece);
        if (settle(piece, found)) return;
        const Vec3 centre = piece.shape.centroid();
        const Hit middle = nearest(centre, piece.near);
        found.steps += middle.tests / kTestsAStep;
        const double distance = std::sqrt(middle.squared_distance);
        found.see(distance, centre);
        piece.upper = std::min(piece.upper, distance + piece.shape.radius(centre));
        if (settle(piece, found)) return;
        if (middle.element != piece.near) corner = bound_by(middle.element, piece);
        if (settle(piece, found)) return;
        piece.near = middle.element;
        ++piece.cuts;
        if (piece.cuts % kHalvedEvery != 0 && cut_along_sides(piece, stack)) return;
        // Over one shape, the corner furthest from it is likely to be as far from all others.
        const Hit furthest = nearest(corner, middle.element);
        found.steps += furthest.tests / kTestsAStep;
        found.see(std::sqrt(furthest.squared_distance), corner);
        if (settle(piece, found)) return;
        auto [first, second] = piece.shape.halve();
        stack.push_back({std::move(second), piece.upper, piece.near, piece.cuts});
        stack.push_back({std::move(first), piece.upper, piece.near, piece.cuts});
    }

    [[nodiscard]] bool settle(const Piece& piece, Findings& found) const {
        if (!(piece.upper <= enough(found.lower))) return false;
        found.settled = std::max(found.settled, piece.upper);
        return true;
    }

    /// Cuts off what reaches beyond the sides of the shape near it. False where it lies within, or reaches beyond hardly or
    /// altogether.
    bool cut_along_sides(const Piece& piece, std::vector<Piece>& stack) const {
        const double least = kLeastSlice * piece.shape.radius(piece.shape.centroid());
        ConvexPiece inside = piece.shape;
        bool cut = false;
        for (const HalfSpace& side : to_.shape(piece.near).sides()) {
            if (!reaches_beyond(inside, side, least)) continue;
            auto parts = inside.cut(side);
            if (!parts) continue;
            stack.push_back({std::move(parts->second), piece.upper, piece.near, piece.cuts});
            inside = std::move(parts->first);
            cut = true;
        }
        if (cut) stack.push_back({std::move(inside), piece.upper, piece.near, piece.cuts});
        return cut;
    }

    /// Whether it has points on either side, further than `least` from it.
    [[nodiscard]] static bool reaches_beyond(const ConvexPiece& piece, const HalfSpace& side, double least) {
        double low = std::numeric_limits<double>::infinity();
        double high = -low;
        for (const Vec3& p : piece.corners()) {
            const double excess = side.excess(p);
            low = std::min(low, excess);
            high = std::max(high, excess);
        }
        return low < -least && high > least;
    }

    struct Vertex {
        double distance = 0;
        std::uint32_t near = 0;
    };

    const ShapesOf<Shape>& from_;
    const ShapeIndex<Shape>& to_;
    const SearchLimits& limits_;
    const ExecutionContext& context_;
    const SearchProgress& progress_;
    std::vector<Vertex> vertices_;
    Findings all_;
};

}  // namespace

template <class Shape>
Expected<DirectedDeviation> directed_deviation(const ShapesOf<Shape>& from, const ShapeIndex<Shape>& to,
                                               const SearchLimits& limits, const ExecutionContext& context,
                                               const SearchProgress& progress) {
    if (from.elements.empty()) return DirectedDeviation{};
    if (to.empty()) {
        constexpr double kInfinity = std::numeric_limits<double>::infinity();
        return DirectedDeviation{kInfinity, kInfinity, from.positions[from.elements[0][0]]};
    }
    return Search<Shape>(from, to, limits, context, progress).run();
}

template Expected<DirectedDeviation> directed_deviation(const ShapesOf<TriangleShape>&, const SurfaceIndex&, const SearchLimits&,
                                                        const ExecutionContext&, const SearchProgress&);
template Expected<DirectedDeviation> directed_deviation(const ShapesOf<SegmentShape>&, const CreaseIndex&, const SearchLimits&,
                                                        const ExecutionContext&, const SearchProgress&);

}  // namespace vsplit

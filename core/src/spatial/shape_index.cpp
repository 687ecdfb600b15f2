#include "spatial/shape_index.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace vsplit {
namespace {

constexpr std::uint32_t kLeafSize = 4;
constexpr std::size_t kBins = 16;

/// From here on ranges are halved, whatever their shape: paths stay under kDeepestCut + 32 nodes, and the search's stack, which
/// takes three entries a node, in bounds.
constexpr std::uint32_t kDeepestCut = 48;
constexpr std::size_t kStack = 3 * (kDeepestCut + 32) + 1;

/// Ranges larger than this are built by several threads.
constexpr std::size_t kParallelRange = 1U << 14U;

/// Boxes are in single precision in a frame where the shapes lie within -1..1. Widening them by kMargin and shrinking squared
/// distances by kShrink covers the rounding of boxes and queries, 2^-24 each a few times, so that no nearest shape is missed;
/// a query beyond kFar (in that frame) is as good as one at kFar, and its square fits.
constexpr float kMargin = 0x1p-21F;
constexpr double kShrink = 1 - 0x1p-19;
constexpr double kFar = 1e18;

struct FloatBox {
    std::array<float, 3> min{HUGE_VALF, HUGE_VALF, HUGE_VALF};
    std::array<float, 3> max{-HUGE_VALF, -HUGE_VALF, -HUGE_VALF};

    void add(const FloatBox& other) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            min[axis] = std::min(min[axis], other.min[axis]);
            max[axis] = std::max(max[axis], other.max[axis]);
        }
    }
    /// Half the surface.
    [[nodiscard]] float area() const {
        const float x = max[0] - min[0];
        const float y = max[1] - min[1];
        const float z = max[2] - min[2];
        return x < 0 ? 0 : x * y + y * z + z * x;
    }
};

/// A shape to be placed.
struct Item {
    FloatBox box;
    std::uint32_t element = 0;

    /// Twice the middle of the box.
    [[nodiscard]] float middle(std::size_t axis) const { return box.min[axis] + box.max[axis]; }
};

struct Range {
    std::size_t begin = 0;
    std::size_t end = 0;
    std::uint32_t depth = 0;

    [[nodiscard]] std::size_t size() const { return end - begin; }
};

FloatBox box_of(const std::vector<Item>& items, const Range& range) {
    FloatBox box;
    for (std::size_t i = range.begin; i < range.end; ++i) box.add(items[i].box);
    return box;
}

/// Cuts ranges of items in two by the surface-area heuristic over bins of the longest axis.
class Splitter {
public:
    explicit Splitter(std::vector<Item>& items) : items_(items) {}

    /// \pre at least two items.
    [[nodiscard]] std::pair<Range, Range> split(const Range& range) {
        find_axis(range);
        std::size_t middle = range.begin;
        if (range.depth < kDeepestCut && width_ > 0) middle = cut_by_area(range);
        if (middle == range.begin || middle == range.end) middle = halve(range);
        return {{range.begin, middle, range.depth + 1}, {middle, range.end, range.depth + 1}};
    }

private:
    void find_axis(const Range& range) {
        std::array<float, 3> low{HUGE_VALF, HUGE_VALF, HUGE_VALF};
        std::array<float, 3> high{-HUGE_VALF, -HUGE_VALF, -HUGE_VALF};
        for (std::size_t i = range.begin; i < range.end; ++i) {
            for (std::size_t axis = 0; axis < 3; ++axis) {
                low[axis] = std::min(low[axis], items_[i].middle(axis));
                high[axis] = std::max(high[axis], items_[i].middle(axis));
            }
        }
        axis_ = 0;
        for (std::size_t axis = 1; axis < 3; ++axis) {
            if (high[axis] - low[axis] > high[axis_] - low[axis_]) axis_ = axis;
        }
        low_ = low[axis_];
        width_ = high[axis_] - low[axis_];
    }

    [[nodiscard]] std::size_t bin(const Item& item) const {
        const auto at = static_cast<std::size_t>((item.middle(axis_) - low_) / width_ * static_cast<float>(kBins));
        return std::min(at, kBins - 1);
    }

    [[nodiscard]] std::size_t cut_by_area(const Range& range) {
        std::array<FloatBox, kBins> boxes;
        std::array<std::size_t, kBins> counts{};
        for (std::size_t i = range.begin; i < range.end; ++i) {
            const std::size_t b = bin(items_[i]);
            boxes[b].add(items_[i].box);
            ++counts[b];
        }
        const std::size_t first_right = cheapest_cut(boxes, counts);
        const auto begin = items_.begin() + static_cast<std::ptrdiff_t>(range.begin);
        const auto end = items_.begin() + static_cast<std::ptrdiff_t>(range.end);
        const auto middle = std::partition(begin, end, [&](const Item& item) { return bin(item) < first_right; });
        return static_cast<std::size_t>(middle - items_.begin());
    }

    /// The first bin of the right side.
    [[nodiscard]] static std::size_t cheapest_cut(const std::array<FloatBox, kBins>& boxes,
                                                  const std::array<std::size_t, kBins>& counts) {
        std::array<float, kBins> right_cost{};
        FloatBox right;
        std::size_t right_count = 0;
        for (std::size_t b = kBins - 1; b > 0; --b) {
            right.add(boxes[b]);
            right_count += counts[b];
            right_cost[b] = right.area() * static_cast<float>(right_count);
        }
        FloatBox left;
        std::size_t left_count = 0;
        std::size_t best = kBins / 2;
        float best_cost = HUGE_VALF;
        for (std::size_t b = 1; b < kBins; ++b) {
            left.add(boxes[b - 1]);
            left_count += counts[b - 1];
            const float cost = left.area() * static_cast<float>(left_count) + right_cost[b];
            if (cost < best_cost && left_count > 0) {
                best_cost = cost;
                best = b;
            }
        }
        return best;
    }

    [[nodiscard]] std::size_t halve(const Range& range) {
        const std::size_t middle = range.begin + range.size() / 2;
        const auto at = [&](std::size_t i) { return items_.begin() + static_cast<std::ptrdiff_t>(i); };
        std::nth_element(at(range.begin), at(middle), at(range.end), [&](const Item& left, const Item& right) {
            const float l = left.middle(axis_);
            const float r = right.middle(axis_);
            return l != r ? l < r : left.element < right.element;
        });
        return middle;
    }

    std::vector<Item>& items_;
    std::size_t axis_ = 0;
    float low_ = 0;
    float width_ = 0;
};

/// Axes, as rows, along which boxes are slim: those of the shapes' sides where these are much longer in one direction than the
/// shapes are wide, as of cables and of needles that fill strips. A box along other axes holds all that lies about a needle.
template <class Shape>
Eigen::Matrix3d own_axes(const std::vector<Shape>& shapes) {
    constexpr double kDominant = 0.9;  // share of the sides' squared lengths
    Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
    for (const Shape& shape : shapes) {
        for (std::size_t i = 0; i < Shape::kCorners; ++i) {
            const Vec3 side = shape.corners[(i + 1) % Shape::kCorners] - shape.corners[i];
            spread += side * side.transpose();
        }
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(spread);
    if (solver.info() != Eigen::Success || !(solver.eigenvalues()[2] > kDominant * spread.trace())) {
        return Eigen::Matrix3d::Identity();
    }
    return solver.eigenvectors().transpose();
}

}  // namespace

template <class Shape>
class ShapeIndex<Shape>::Builder {
public:
    explicit Builder(std::vector<Item>& items) : items_(items) {}

    /// Nodes of the range, its root first, in an order that depends on the items alone.
    [[nodiscard]] std::vector<Node> build(const Range& range) {
        std::vector<Node> nodes;
        if (range.size() <= kParallelRange) {
            append(range, nodes);
            return nodes;
        }
        const Children children = cut(range);
        std::array<std::vector<Node>, kWidth> parts;
        tbb::parallel_for(std::size_t{0}, children.count, [&](std::size_t i) {
            if (children.ranges[i].size() > kLeafSize) parts[i] = build(children.ranges[i]);
        });
        nodes.push_back(node_over(children));
        for (std::size_t i = 0; i < children.count; ++i) join(parts[i], i, nodes);
        return nodes;
    }

private:
    struct Children {
        std::array<Range, kWidth> ranges;
        std::size_t count = 0;
    };

    /// Cuts the largest until there are four, or all are leaves.
    [[nodiscard]] Children cut(const Range& range) {
        Children children{{range}, 1};
        Splitter splitter(items_);
        while (children.count < kWidth) {
            const auto end = children.ranges.begin() + static_cast<std::ptrdiff_t>(children.count);
            const auto largest = std::max_element(children.ranges.begin(), end,
                                                  [](const Range& l, const Range& r) { return l.size() < r.size(); });
            if (largest->size() <= kLeafSize) break;
            const auto [left, right] = splitter.split(*largest);
            *largest = left;
            children.ranges[children.count++] = right;
        }
        return children;
    }

    [[nodiscard]] Node node_over(const Children& children) const {
        Node node;
        node.child.fill(kNoElement);
        node.count.fill(0);
        node.min.fill(Lanes{} + HUGE_VALF);
        node.max.fill(Lanes{} - HUGE_VALF);
        for (std::size_t i = 0; i < children.count; ++i) {
            const FloatBox box = box_of(items_, children.ranges[i]);
            for (std::size_t axis = 0; axis < 3; ++axis) {
                node.min[axis][i] = box.min[axis];
                node.max[axis][i] = box.max[axis];
            }
            node.child[i] = static_cast<std::uint32_t>(children.ranges[i].begin);
            node.count[i] = children.ranges[i].size() <= kLeafSize ? static_cast<std::uint32_t>(children.ranges[i].size()) : 0;
        }
        return node;
    }

    void append(const Range& range, std::vector<Node>& nodes) {
        const Children children = cut(range);
        const std::size_t at = nodes.size();
        nodes.push_back(node_over(children));
        for (std::size_t i = 0; i < children.count; ++i) {
            if (children.ranges[i].size() <= kLeafSize) continue;
            nodes[at].child[i] = static_cast<std::uint32_t>(nodes.size());
            append(children.ranges[i], nodes);
        }
    }

    /// Puts the nodes of child i of nodes[0] behind the others.
    static void join(const std::vector<Node>& part, std::size_t i, std::vector<Node>& nodes) {
        if (part.empty()) return;
        const auto shift = static_cast<std::uint32_t>(nodes.size());
        nodes[0].child[i] = shift;
        for (Node node : part) {
            for (std::size_t lane = 0; lane < kWidth; ++lane) {
                if (node.count[lane] == 0 && node.child[lane] != kNoElement) node.child[lane] += shift;
            }
            nodes.push_back(node);
        }
    }

    std::vector<Item>& items_;
};

template <class Shape>
Eigen::Vector3f ShapeIndex<Shape>::in_own_frame(const Vec3& p) const {
    const Vec3 own = turn_ * ((p - centre_) * scale_);
    return own.cwiseMax(-kFar).cwiseMin(kFar).template cast<float>();
}

template <class Shape>
ShapeIndex<Shape>::ShapeIndex(std::vector<Shape> shapes) {
    if (shapes.empty()) return;
    BoundingBox box;
    for (const Shape& shape : shapes) {
        for (const Vec3& p : shape.corners) {
            box.min = box.min.cwiseMin(p);
            box.max = box.max.cwiseMax(p);
        }
    }
    centre_ = (box.min + box.max) / 2;
    const double reach = box.diagonal() / 2;
    scale_ = reach > 1e-150 ? 1 / reach : 1;
    turn_ = own_axes(shapes);

    std::vector<Item> items(shapes.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, items.size(), 4096), [&](const tbb::blocked_range<std::size_t>& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
            items[i].element = static_cast<std::uint32_t>(i);
            for (const Vec3& corner : shapes[i].corners) {
                const Eigen::Vector3f p = in_own_frame(corner);
                items[i].box.add(
                    {{p.x() - kMargin, p.y() - kMargin, p.z() - kMargin}, {p.x() + kMargin, p.y() + kMargin, p.z() + kMargin}});
            }
        }
    });
    nodes_ = Builder(items).build({0, items.size(), 0});

    shapes_.resize(shapes.size());
    element_.resize(shapes.size());
    slot_.resize(shapes.size());
    for (std::uint32_t slot = 0; slot < items.size(); ++slot) {
        element_[slot] = items[slot].element;
        slot_[items[slot].element] = slot;
        shapes_[slot] = Prepared(shapes[items[slot].element]);
    }
}

/// A point in the frame of the boxes.
template <class Shape>
struct ShapeIndex<Shape>::Query {
    explicit Query(const Eigen::Vector3f& own) {
        for (int axis = 0; axis < 3; ++axis) at[static_cast<std::size_t>(axis)] = Lanes{} + own[axis];
    }

    /// Squared distances to the boxes of a node's children.
    [[nodiscard]] Lanes to_boxes(const Node& node) const {
        Lanes sum{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const Lanes below = node.min[axis] - at[axis];
            const Lanes above = at[axis] - node.max[axis];
            Lanes outside = below > above ? below : above;
            outside = outside > 0.0F ? outside : Lanes{};
            sum += outside * outside;
        }
        return sum;
    }

    std::array<Lanes, 3> at;
};

/// What a box's squared distance, in its frame, is at most when it may hold something this near.
template <class Shape>
double ShapeIndex<Shape>::far_bound(double squared_distance) const {
    return squared_distance * scale_ * scale_ / kShrink;
}

template <class Shape>
void ShapeIndex<Shape>::search_leaf(const Vec3& p, std::uint32_t first, std::uint32_t count, Hit& hit) const {
    hit.tests += count;
    for (std::uint32_t slot = first; slot < first + count; ++slot) {
        const Footpoint foot = shapes_[slot].closest(p, hit.squared_distance);
        const bool nearer = foot.squared_distance < hit.squared_distance ||
                            (foot.squared_distance == hit.squared_distance && element_[slot] < hit.element);
        if (nearer) hit = {foot.squared_distance, foot.point, element_[slot], hit.tests};
    }
}

template <class Shape>
auto ShapeIndex<Shape>::search(const Vec3& p, double upper_squared, double enough) const -> Hit {
    struct Entry {
        float distance;
        std::uint32_t child;
        std::uint32_t count;
    };
    Hit hit{upper_squared, p, kNoElement, 0};
    if (nodes_.empty()) return hit;
    const Query query(in_own_frame(p));
    double bound = far_bound(upper_squared);
    std::array<Entry, kStack> stack;  // NOLINT: filling it would cost more than the search
    std::size_t height = 0;
    stack[height++] = {0, 0, 0};
    while (height > 0) {
        const Entry top = stack[--height];
        if (top.distance > bound) continue;
        if (top.count > 0) {
            search_leaf(p, top.child, top.count, hit);
            if (hit.element != kNoElement && hit.squared_distance <= enough) return hit;
            bound = far_bound(hit.squared_distance);
            continue;
        }
        const Node& node = nodes_[top.child];
        const Lanes distances = query.to_boxes(node);
        const std::size_t bottom = height;
        for (std::size_t lane = 0; lane < kWidth && node.child[lane] != kNoElement; ++lane) {
            const Entry entry{distances[lane], node.child[lane], node.count[lane]};
            if (entry.distance > bound) continue;
            // The nearest on top; of equally near ones the first.
            std::size_t at = height++;
            assert(height <= kStack);
            for (; at > bottom && stack[at - 1].distance <= entry.distance; --at) stack[at] = stack[at - 1];
            stack[at] = entry;
        }
    }
    return hit;
}

template class ShapeIndex<TriangleShape>;
template class ShapeIndex<SegmentShape>;

}  // namespace vsplit

#include "method/cut_needles.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include "mesh/cap_boundaries.h"
#include "method/editable_mesh.h"
#include "simplify/flip_quad.h"

namespace vsplit {
namespace {

constexpr double kLongest = 2;  // times the height of a face over it
constexpr std::uint32_t kMostFaces = 400'000;
constexpr std::uint32_t kLookEvery = 4096;
/// Flips end by themselves on a plane; rounding must not make them go round.
constexpr std::size_t kMostFlipsAFace = 64;
constexpr std::uint32_t kNoPlace = std::numeric_limits<std::uint32_t>::max();

/// Works on a closed mesh whose first vertices may be ghosts.
class NeedleCutter {
public:
    NeedleCutter(const CappedMesh& capped, const std::vector<SharpEdge>& creases, double gap)
        : mesh_(capped.mesh, creases), ghosts_(capped.ghosts), gap_(gap) {
        find_places();
    }

    void cut(double size, const ExecutionContext& context) {
        while (!context.cancelled()) {
            const std::vector<HalfEdge> needles = edges_of_needles(size);
            if (needles.empty() || mesh_.mesh().face_count() + 2 * needles.size() > kMostFaces) break;
            halve(needles);
            flip_open(context);
        }
    }

    [[nodiscard]] const EditableMesh& mesh() const { return mesh_; }
    /// The thickest slab.
    [[nodiscard]] double moved() const { return moved_; }

private:
    /// A flat place.
    struct Place {
        Vec3 normal = Vec3::Zero();
        double low = 0, high = 0;  // of its vertices, along the normal
    };

    [[nodiscard]] HalfEdge half_edges() const { return 3 * mesh_.mesh().face_count(); }

    [[nodiscard]] const Vec3& at(HalfEdge h) const { return mesh_.position(mesh_.origin(h)); }

    [[nodiscard]] Vec3 twice_area(std::uint32_t f) const { return (at(3 * f + 1) - at(3 * f)).cross(at(3 * f + 2) - at(3 * f)); }

    [[nodiscard]] bool is_ghost(std::uint32_t f) const {
        return std::min({mesh_.origin(3 * f), mesh_.origin(3 * f + 1), mesh_.origin(3 * f + 2)}) < ghosts_;
    }

    /// From the largest face on, whose planes are the surest.
    void find_places() {
        std::vector<double> areas(mesh_.mesh().faces.size());
        for (std::uint32_t f = 0; f < areas.size(); ++f) areas[f] = twice_area(f).squaredNorm();
        std::vector<std::uint32_t> order(areas.size());
        std::iota(order.begin(), order.end(), 0U);
        std::stable_sort(order.begin(), order.end(), [&](std::uint32_t l, std::uint32_t r) { return areas[l] > areas[r]; });
        place_of_.assign(areas.size(), kNoPlace);
        for (const std::uint32_t f : order) {
            if (place_of_[f] == kNoPlace) find_place(f);
        }
    }

    void find_place(std::uint32_t seed) {
        const auto number = static_cast<std::uint32_t>(places_.size());
        const double height = twice_area(seed).normalized().dot(at(3 * seed));
        places_.push_back({twice_area(seed).normalized(), height, height});
        place_of_[seed] = number;
        std::vector<std::uint32_t> open{seed};
        while (!open.empty() && !is_ghost(seed)) {
            const std::uint32_t f = open.back();
            open.pop_back();
            for (const HalfEdge h : {3 * f, 3 * f + 1, 3 * f + 2}) {
                const std::uint32_t beyond = face_of(mesh_.twin(h));
                if (place_of_[beyond] != kNoPlace || mesh_.is_crease(h) || !extends(places_.back(), beyond)) continue;
                place_of_[beyond] = number;
                open.push_back(beyond);
            }
        }
        moved_ = std::max(moved_, places_.back().high - places_.back().low);
    }

    /// Whether a face lies in the slab and looks the same way; then the place takes it in.
    [[nodiscard]] bool extends(Place& place, std::uint32_t f) const {
        if (is_ghost(f)) return false;
        Place wider = place;
        for (const HalfEdge h : {3 * f, 3 * f + 1, 3 * f + 2}) {
            const double height = place.normal.dot(at(h));
            wider.low = std::min(wider.low, height);
            wider.high = std::max(wider.high, height);
        }
        if (wider.high - wider.low > gap_ || !looks_along(place.normal, at(3 * f), at(3 * f + 1), at(3 * f + 2))) return false;
        place = wider;
        return true;
    }

    /// Of a face that is lower than the gap only rounding says where it looks.
    [[nodiscard]] bool looks_along(const Vec3& normal, const Vec3& a, const Vec3& b, const Vec3& c) const {
        const Vec3 own = (b - a).cross(c - a);
        const double area = own.norm();
        const double longest = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
        return own.dot(normal) >= kLeastFlipCosine * area || area <= gap_ * longest;
    }

    [[nodiscard]] double length_of(HalfEdge h) const { return (at(next(h)) - at(h)).norm(); }

    /// Whether its edge bounds a place.
    [[nodiscard]] bool bounds_place(HalfEdge h) const {
        return mesh_.is_crease(h) || place_of_[face_of(h)] != place_of_[face_of(mesh_.twin(h))];
    }

    /// Half-edges, one an edge.
    [[nodiscard]] std::vector<HalfEdge> edges_of_needles(double size) const {
        std::vector<HalfEdge> found;
        for (HalfEdge h = 0; h < half_edges(); ++h) {
            const HalfEdge g = mesh_.twin(h);
            if (h > g || !bounds_place(h) || is_ghost(face_of(h)) || is_ghost(face_of(g))) continue;
            const double length = length_of(h);
            const double area = std::min(twice_area(face_of(h)).norm(), twice_area(face_of(g)).norm());
            if (length > size && length * length > kLongest * area) found.push_back(h);
        }
        return found;
    }

    /// Each but those of faces that one before has cut, which have other numbers now.
    void halve(const std::vector<HalfEdge>& edges) {
        std::vector<bool> is_cut(mesh_.mesh().faces.size(), false);
        for (const HalfEdge h : edges) {
            const std::uint32_t left = face_of(h), right = face_of(mesh_.twin(h));
            if (std::max(left, right) >= is_cut.size() || is_cut[left] || is_cut[right]) continue;
            is_cut[left] = is_cut[right] = true;
            halve(h);
        }
    }

    /// Flips are tried on the edges around it.
    void halve(HalfEdge h) {
        const std::uint32_t left = place_of_[face_of(h)], right = place_of_[face_of(mesh_.twin(h))];
        const Vec3 middle = (at(h) + at(next(h))) / 2;
        const std::uint32_t vertex = mesh_.split(h, middle);
        place_of_.push_back(left);
        place_of_.push_back(right);
        for (const HalfEdge spoke : mesh_.spokes(vertex)) {
            open_.push_back(spoke);
            open_.push_back(next(spoke));
        }
    }

    void flip_open(const ExecutionContext& context) {
        const std::size_t most = kMostFlipsAFace * mesh_.mesh().faces.size();
        std::size_t flips = 0;
        for (std::size_t looks = 1; !open_.empty() && flips < most; ++looks) {
            if (looks % kLookEvery == 0 && context.cancelled()) break;
            const HalfEdge h = open_.back();
            open_.pop_back();
            flips += flip_if_better(h) ? 1 : 0;
        }
        open_.clear();
    }

    bool flip_if_better(HalfEdge h) {
        const HalfEdge g = mesh_.twin(h);
        const std::uint32_t a = mesh_.origin(h), b = mesh_.origin(g), c = mesh_.origin(prev(h)), d = mesh_.origin(prev(g));
        if (bounds_place(h) || mesh_.valence(a) <= 3 || mesh_.valence(b) <= 3) return false;
        const Vec3 &pa = mesh_.position(a), &pb = mesh_.position(b), &pc = mesh_.position(c), &pd = mesh_.position(d);
        const Vec3& normal = places_[place_of_[face_of(h)]].normal;
        if (!is_within_circle(pa, pb, pc, pd) || !looks_along(normal, pd, pc, pa) || !looks_along(normal, pc, pd, pb))
            return false;
        if (mesh_.has_edge(c, d)) return false;
        mesh_.turn(h);
        for (const HalfEdge side : {next(h), prev(h), next(g), prev(g)}) open_.push_back(side);
        return true;
    }

    EditableMesh mesh_;
    const std::uint32_t ghosts_;
    const double gap_;
    std::vector<Place> places_;
    std::vector<std::uint32_t> place_of_;  // of the faces
    double moved_ = 0;
    std::vector<HalfEdge> open_;  // edges to look at, last first
};

}  // namespace

CreasedMesh cut_needles(const CreasedMesh& creased, double size, double gap, const ExecutionContext& context) {
    const CappedMesh capped = cap_manifold(creased.mesh);
    NeedleCutter cutter(capped, with_ghosts(creased.creases, capped.ghosts), gap);
    cutter.cut(size, context);
    return {visible_mesh(cutter.mesh().mesh(), capped.ghosts), without_ghosts(cutter.mesh().creases(), capped.ghosts),
            creased.moved + cutter.moved()};
}

}  // namespace vsplit

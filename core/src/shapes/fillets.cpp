#include "shapes/fillets.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "shapes/rims.h"
#include "shapes/tube_surface.h"

namespace vsplit {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kLeastTurn = 20 * kDegree, kMostTurn = 150 * kDegree;  // from one side to the other
constexpr double kOneRadius = 0.08;   // on no cylinder or torus: share of the middle radius that sections may be off it
constexpr std::size_t kFewEdges = 3;  // so many at a side of a run that bends say nothing: any surface has some
constexpr double kLittleMore = 1.5;   // times the faces of a tube
constexpr double kTangent = 0.75;     // most bend at the sides over that between strips: an arc on its tangent has a half
constexpr double kAlongSide = 0.7;    // cosine to the run of an edge at the side; of one at the end it is less

using Side = std::vector<std::uint32_t>;

/// The faces of what may be a fillet.
struct Candidate {
    std::vector<std::uint32_t> faces;  // ascending
    std::vector<Vec3> along;           // of each where the tube runs
    std::optional<TubeSurface> surface;
};

/// Its border in parts.
struct Sides {
    std::array<std::vector<HalfEdge>, 2> sides;  // both in the direction of their half-edges, so one against the other
    std::vector<HalfEdge> ends;                  // of both ends; none where the run is closed
};

class FilletFinder {
public:
    FilletFinder(const TriangleMesh& mesh, const FaceNormals& normals, const std::vector<HalfEdge>& twin, double angle)
        : mesh_(mesh), normals_(normals), twin_(twin), most_bend_(angle * kDegree), tried_(mesh.faces.size(), false) {}

    std::vector<ShapeFeature> run(std::vector<Tube> tubes) {
        std::vector<ShapeFeature> fillets;
        // A surface that fell into several tubes, or has some across as well, is gathered from the largest.
        std::stable_sort(tubes.begin(), tubes.end(),
                         [](const Tube& l, const Tube& r) { return l.faces.size() > r.faces.size(); });
        for (const Tube& tube : tubes) {
            if (std::all_of(tube.faces.begin(), tube.faces.end(), [&](std::uint32_t f) { return tried_[f]; })) continue;
            std::optional<ShapeFeature> fillet = best_of(tube);
            if (fillet) fillets.push_back(*std::move(fillet));
        }
        return fillets;
    }

private:
    std::optional<ShapeFeature> best_of(const Tube& tube) {
        const Candidate alone{tube.faces, tube.along, fit_surface(mesh_, tube)};
        const Candidate grown = alone.surface ? grown_from(tube, *alone.surface) : alone;
        for (const std::uint32_t f : grown.faces) tried_[f] = true;
        const double most = kLittleMore * static_cast<double>(tube.faces.size());
        std::optional<ShapeFeature> fillet = fillet_of(tube, grown);
        // Some faces of a ball at its end may have come to it, which are near the surface as well.
        if (!fillet && static_cast<double>(grown.faces.size()) < most) fillet = fillet_of(tube, alone);
        return fillet;
    }

    Candidate grown_from(const Tube& tube, const TubeSurface& surface) const {
        Candidate candidate{faces_on(surface, mesh_, normals_, twin_, tube, most_bend_), {}, surface};
        for (const std::uint32_t f : candidate.faces) {
            const Triangle& t = mesh_.faces[f];
            const Vec3 middle = (mesh_.positions[t[0]] + mesh_.positions[t[1]] + mesh_.positions[t[2]]) / 3;
            candidate.along.push_back(surface.along_at(middle));
        }
        return candidate;
    }

    std::optional<ShapeFeature> fillet_of(const Tube& tube, const Candidate& candidate) const {
        const std::optional<Sides> sides = sides_of(candidate);
        if (!sides) return {};
        const bool bends = !candidate.surface || candidate.surface->out > 0;
        if (bends && std::min(sides->sides[0].size(), sides->sides[1].size()) <= kFewEdges) return {};
        const std::optional<double> radius = candidate.surface ? candidate.surface->radius : middle_radius(tube);
        if (!radius) return {};
        const double length = (length_of(sides->sides[0]) + length_of(sides->sides[1])) / 2;
        const double width = area_of(candidate.faces) / length;
        if (!(width > kLeastTurn * *radius && width < kMostTurn * *radius)) return {};
        if (!is_tangent(tube, *sides) || (length < width && !ends_at_creases(*sides))) return {};
        ShapeFeature fillet;
        fillet.kind = ShapeFeature::Kind::kFillet;
        fillet.diameter = 2 * *radius;
        fillet.depth = length;
        fillet.axis = run_of(tube).direction;
        fillet.centre = centre_of(tube, candidate, *sides);
        fillet.faces = candidate.faces;
        fillet.sides = vertices_of(*sides);
        return fillet;
    }

    const Vec3& point(HalfEdge h) const { return mesh_.positions[origin(mesh_, h)]; }
    Vec3 vector_of(HalfEdge h) const { return point(next(h)) - point(h); }

    double bend_at(HalfEdge h) const {
        const Vec3 &a = normals_.normals[face_of(h)], &b = normals_.normals[face_of(twin_[h])];
        return std::atan2(a.cross(b).norm(), a.dot(b));
    }

    double length_of(const std::vector<HalfEdge>& edges) const {
        double sum = 0;
        for (const HalfEdge h : edges) sum += vector_of(h).norm();
        return sum;
    }

    double area_of(const std::vector<std::uint32_t>& faces) const {
        double sum = 0;
        for (const std::uint32_t f : faces) sum += vector_of(3 * f).cross(vector_of(3 * f + 1)).norm() / 2;
        return sum;
    }

    bool at_side(const Candidate& candidate, HalfEdge h) const {
        const auto f = std::lower_bound(candidate.faces.begin(), candidate.faces.end(), face_of(h)) - candidate.faces.begin();
        return std::abs(vector_of(h).dot(candidate.along[static_cast<std::size_t>(f)])) > kAlongSide * vector_of(h).norm();
    }

    /// Two loops along the run, or one of a side, an end, a side and an end.
    std::optional<Sides> sides_of(const Candidate& candidate) const {
        Expected<std::vector<Rim>> rims = find_rims(mesh_, twin_, candidate.faces);
        if (!rims || rims->empty() || rims->size() > 2) return {};
        if (rims->size() == 1) return sides_of_loop(candidate, std::move(rims->front()));
        for (const Rim& rim : *rims) {
            if (!std::all_of(rim.begin(), rim.end(), [&](HalfEdge h) { return at_side(candidate, h); })) return {};
        }
        return Sides{{std::move((*rims)[0]), std::move((*rims)[1])}, {}};
    }

    std::optional<Sides> sides_of_loop(const Candidate& candidate, Rim rim) const {
        std::size_t begin = 0;  // where a side follows an end
        for (std::size_t i = 0; i < rim.size(); ++i) {
            if (!at_side(candidate, rim[i]) && at_side(candidate, rim[(i + 1) % rim.size()])) begin = i + 1;
        }
        std::rotate(rim.begin(), rim.begin() + static_cast<std::ptrdiff_t>(begin % rim.size()), rim.end());
        Sides sides;
        std::size_t parts = 0;
        bool side = false;
        for (const HalfEdge h : rim) {
            if (parts == 0 || at_side(candidate, h) != side) {
                side = at_side(candidate, h);
                if (++parts > 4 || side != (parts % 2 == 1)) return {};
            }
            (side ? sides.sides[parts / 2] : sides.ends).push_back(h);
        }
        if (parts != 4) return {};
        return sides;
    }

    /// Of a run on no line or circle, by its sections.
    static std::optional<double> middle_radius(const Tube& tube) {
        std::vector<double> radii;
        for (const TubeSection& s : tube.sections) radii.push_back(s.radius);
        std::sort(radii.begin(), radii.end());
        const double middle = radii[radii.size() / 2];
        if (std::max(middle - radii.front(), radii.back() - middle) > kOneRadius * middle) return {};
        return middle;
    }

    /// Whether the sides bend like those of an arc on its tangent, not like a place between strips or an edge.
    bool is_tangent(const Tube& tube, const Sides& sides) const {
        double inside = 0, length = 0;
        for (const TubeSection& s : tube.sections) {
            inside += s.length * s.bend;
            length += s.length;
        }
        return std::all_of(sides.sides.begin(), sides.sides.end(), [&](const std::vector<HalfEdge>& side) {
            double sum = 0;
            for (const HalfEdge h : side) sum += vector_of(h).norm() * bend_at(h);
            return sum / length_of(side) <= kTangent * inside / length;
        });
    }

    bool ends_at_creases(const Sides& sides) const {
        return std::all_of(sides.ends.begin(), sides.ends.end(), [&](HalfEdge h) { return bend_at(h) > most_bend_; });
    }

    Vec3 centre_of(const Tube& tube, const Candidate& candidate, const Sides& sides) const {
        if (!candidate.surface) return run_of(tube).centre;
        const TubeSurface& surface = *candidate.surface;
        if (surface.out > 0) return sides.ends.empty() ? surface.axis.point : run_of(tube).centre;
        double along = 0;
        for (const std::vector<HalfEdge>& side : sides.sides)
            along += (surface.axis.along(point(side.front())) + surface.axis.along(point(next(side.back())))) / 4;
        return surface.axis.point + along * surface.axis.direction;
    }

    /// Both in the direction of the first one's half-edges.
    std::array<Side, 2> vertices_of(const Sides& sides) const {
        std::array<Side, 2> vertices;
        Side &first = vertices[0], &second = vertices[1];
        const bool closed = sides.ends.empty();
        for (std::size_t i = 0; i < 2; ++i) {
            vertices[i] = origins(mesh_, sides.sides[i]);
            if (!closed) vertices[i].push_back(origin(mesh_, next(sides.sides[i].back())));
        }
        std::reverse(second.begin(), second.end());
        if (!closed) return vertices;
        const Vec3& start = mesh_.positions[first.front()];
        const auto nearer = [&](std::uint32_t l, std::uint32_t r) {
            return (mesh_.positions[l] - start).norm() < (mesh_.positions[r] - start).norm();
        };
        std::rotate(second.begin(), std::min_element(second.begin(), second.end(), nearer), second.end());
        for (Side& side : vertices) side.push_back(side.front());
        return vertices;
    }

    const TriangleMesh& mesh_;
    const FaceNormals& normals_;
    const std::vector<HalfEdge>& twin_;
    const double most_bend_;
    std::vector<bool> tried_;
};

}  // namespace

std::vector<ShapeFeature> find_fillets(const TriangleMesh& mesh, const FaceNormals& normals, const std::vector<HalfEdge>& twin,
                                       double angle) {
    return FilletFinder(mesh, normals, twin, angle).run(find_tubes(mesh, normals, twin, angle));
}

}  // namespace vsplit

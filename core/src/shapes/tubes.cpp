#include "shapes/tubes.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>

#include "mesh/disjoint_sets.h"

namespace vsplit {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kLeastBend = 0.5 * kDegree;  // under it an edge is flat
constexpr double kSameRadius = 0.05;          // relative; sections of a torus are taken along chords, which bends them by this
constexpr double kSameCentre = 0.1;           // of the radius
constexpr double kSameWidth = 2;              // ratio of the widths of strips beside each other
constexpr double kParallel = 0.9;             // cosine, 26 degrees
constexpr double kBesides = 0.5;              // share of an edge that runs beside another
constexpr double kTightest = 1.2;             // radius of the run over that of the tube: a sphere's is 1
constexpr double kAcross = 0.7;               // cosine to the run under which an edge crosses it

std::optional<TubeSection> section_at(const TriangleMesh& mesh, const FaceNormals& normals, HalfEdge h, HalfEdge twin,
                                      double most_bend) {
    if (!normals.reliable[face_of(h)] || !normals.reliable[face_of(twin)]) return {};
    const Vec3 &a = mesh.positions[origin(mesh, h)], &b = mesh.positions[origin(mesh, next(h))];
    const double length = (b - a).norm();
    if (!(length > 0)) return {};
    const Vec3 along = (b - a) / length;
    const auto across = [&](HalfEdge g) {
        const Vec3 arm = mesh.positions[origin(mesh, prev(g))] - a;
        return Vec3(arm - arm.dot(along) * along);
    };
    const Vec3 u = across(h), v = across(twin), turn = u.cross(v);
    const double shorter = std::min(u.norm(), v.norm()), longer = std::max(u.norm(), v.norm());
    if (!(shorter > 0) || longer > kSameWidth * shorter) return {};
    const double bend = std::atan2(turn.norm(), -u.dot(v));
    if (bend < kLeastBend || bend > most_bend) return {};
    const Vec3 arm = (u.squaredNorm() * v - v.squaredNorm() * u).cross(turn) / (2 * turn.squaredNorm());
    return TubeSection{h, (a + b) / 2 + arm, along, length, arm.norm(), bend, arm.dot(normals.normals[face_of(h)]) < 0};
}

/// What lies beside an edge in a strip: the edge at the strip's other side, and the face on it.
struct Beside {
    HalfEdge edge = 0;  ///< in the strip
    std::uint32_t face = 0;
};

class TubeFinder {
public:
    TubeFinder(const TriangleMesh& mesh, const std::vector<HalfEdge>& twin, double most_bend)
        : mesh_(mesh), twin_(twin), most_bend_(most_bend) {}

    std::vector<Tube> run(const FaceNormals& normals) {
        at_.assign(twin_.size(), kNone);
        for (HalfEdge h = 0; h < twin_.size(); ++h) {
            if (twin_[h] < h) continue;
            const std::optional<TubeSection> section = section_at(mesh_, normals, h, twin_[h], most_bend_);
            if (!section || is_tight(*section, normals)) continue;
            at_[h] = at_[twin_[h]] = static_cast<std::uint32_t>(all_.size());
            all_.push_back(*section);
        }
        DisjointSets sets(all_.size());
        std::vector<bool> linked(all_.size(), false);
        for (std::uint32_t s = 0; s < all_.size(); ++s) {
            for_each_beside(all_[s], [&](const Beside& beside) {
                const std::uint32_t other = at_[beside.edge];
                if (other == kNone || !same_circle(all_[s], all_[other])) return;
                linked[s] = linked[other] = true;
                sets.join(s, other);
            });
        }
        link_along(linked, sets);
        std::map<std::uint32_t, Tube> tubes;
        for (std::uint32_t s = 0; s < all_.size(); ++s) {
            if (linked[s]) tubes[sets.find(s)].sections.push_back(all_[s]);
        }
        std::vector<Tube> result;
        for (auto& [root, tube] : tubes) {
            add_faces(tube);
            result.push_back(std::move(tube));
        }
        return result;
    }

private:
    /// How far a face goes along a direction.
    double extent(std::uint32_t f, const Vec3& along) const {
        double least = 0, most = 0;
        for (const std::uint32_t v : mesh_.faces[f]) {
            const double here = (mesh_.positions[v] - mesh_.positions[mesh_.faces[f][0]]).dot(along);
            least = std::min(least, here);
            most = std::max(most, here);
        }
        return most - least;
    }

    /// Whether the surface is bent along the section's edge as it is across it, as on a ball.
    bool is_tight(const TubeSection& s, const FaceNormals& normals) const {
        for (const HalfEdge base : {s.edge, twin_[s.edge]}) {
            for (const HalfEdge side : {next(base), prev(base)}) {
                const Vec3 edge = mesh_.positions[origin(mesh_, next(side))] - mesh_.positions[origin(mesh_, side)];
                if (std::abs(edge.dot(s.along)) > kAcross * edge.norm()) continue;
                const std::uint32_t here = face_of(side), there = face_of(twin_[side]);
                const Vec3 &a = normals.normals[here], &b = normals.normals[there];
                const double bend = std::atan2(a.cross(b).norm(), a.dot(b));
                if (bend > most_bend_) continue;  // where it ends
                if (bend * kTightest * s.radius > (extent(here, s.along) + extent(there, s.along)) / 2) return true;
            }
        }
        return false;
    }

    static bool alike(const TubeSection& l, const TubeSection& r) {
        return l.convex == r.convex && std::abs(l.radius - r.radius) <= kSameRadius * std::min(l.radius, r.radius);
    }

    static bool same_circle(const TubeSection& l, const TubeSection& r) {
        const Vec3 apart = r.centre - l.centre;
        return alike(l, r) && (apart - apart.dot(l.along) * l.along).norm() <= kSameCentre * l.radius;
    }

    /// Whether an edge runs beside the section's, at the tube's radius from its centre line.
    bool runs_beside(const TubeSection& s, const Vec3& p, const Vec3& q) const {
        const double from = (p - s.centre).dot(s.along), to = (q - s.centre).dot(s.along);
        const double length = (q - p).norm(), shorter = std::min(length, s.length);
        if (std::abs(to - from) < kParallel * length) return false;
        const double shared = std::min(std::max(from, to), s.length / 2) - std::max(std::min(from, to), -s.length / 2);
        const auto off = [&](const Vec3& point, double along) {
            return std::abs((point - s.centre - along * s.along).norm() - s.radius);
        };
        return shared > kBesides * shorter && std::max(off(p, from), off(q, to)) <= kSameCentre * s.radius;
    }

    template <class Visit>
    void for_each_beside(const TubeSection& s, const Visit& visit) const {
        for (const HalfEdge base : {s.edge, twin_[s.edge]}) {
            const std::uint32_t apex = origin(mesh_, prev(base));
            for (const HalfEdge side : {next(base), prev(base)}) {
                const HalfEdge g = twin_[side];  // its face has the apex, one end of the base, and another vertex
                const HalfEdge edge = origin(mesh_, g) == apex ? prev(g) : next(g);
                if (runs_beside(s, mesh_.positions[origin(mesh_, edge)], mesh_.positions[origin(mesh_, next(edge))]))
                    visit(Beside{edge, face_of(g)});
            }
        }
    }

    /// Joins sections whose edges follow one another.
    void link_along(const std::vector<bool>& linked, DisjointSets& sets) const {
        std::vector<std::pair<std::uint32_t, std::uint32_t>> ends;  // vertex, section
        for (std::uint32_t s = 0; s < all_.size(); ++s) {
            if (!linked[s]) continue;
            ends.emplace_back(origin(mesh_, all_[s].edge), s);
            ends.emplace_back(origin(mesh_, next(all_[s].edge)), s);
        }
        std::sort(ends.begin(), ends.end());
        for (std::size_t i = 0; i < ends.size(); ++i) {
            for (std::size_t k = i + 1; k < ends.size() && ends[k].first == ends[i].first; ++k) {
                const TubeSection &l = all_[ends[i].second], &r = all_[ends[k].second];
                if (alike(l, r) && follow(l, r, ends[i].first)) sets.join(ends[i].second, ends[k].second);
            }
        }
    }

    bool follow(const TubeSection& l, const TubeSection& r, std::uint32_t at) const {
        const bool l_leaves = origin(mesh_, l.edge) == at, r_leaves = origin(mesh_, r.edge) == at;
        const Vec3 onward = l_leaves == r_leaves ? Vec3(-r.along) : r.along;
        return l.along.dot(onward) > kParallel;
    }

    void add_faces(Tube& tube) const {
        std::map<std::uint32_t, Vec3> faces;
        for (const TubeSection& s : tube.sections) {
            faces.emplace(face_of(s.edge), s.along);
            faces.emplace(face_of(twin_[s.edge]), s.along);
            for_each_beside(s, [&](const Beside& beside) { faces.emplace(beside.face, s.along); });
        }
        for (const auto& [face, along] : faces) {
            tube.faces.push_back(face);
            tube.along.push_back(along);
        }
    }

    const TriangleMesh& mesh_;
    const std::vector<HalfEdge>& twin_;
    const double most_bend_;
    std::vector<TubeSection> all_;
    std::vector<std::uint32_t> at_;  // of each half-edge
};

}  // namespace

std::vector<Tube> find_tubes(const TriangleMesh& mesh, const FaceNormals& normals, const std::vector<HalfEdge>& twin,
                             double angle) {
    return TubeFinder(mesh, twin, angle * kDegree).run(normals);
}

}  // namespace vsplit

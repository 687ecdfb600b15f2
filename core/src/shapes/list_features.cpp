#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "base/number_text.h"
#include "shapes/cylinder.h"
#include "shapes/fillets.h"
#include "vsplit/mesh/inspect.h"
#include "vsplit/shapes/shape_features.h"

namespace vsplit {
namespace {

using Kind = ShapeFeature::Kind;
using Loop = Segments::Loop;

constexpr double kFlat = 0.1;        // share of the normals across the axis under which a ring is a step
constexpr double kParallel = 0.999;  // cosine of the angle between axes that are one

/// Where a chain of segments along an axis ends.
struct End {
    const Loop* rim = nullptr;  ///< null: closed by a bottom or a top
};

class Recogniser {
public:
    Recogniser(const TriangleMesh& mesh, double angle)
        : mesh_(mesh),
          angle_(angle),
          normals_(face_normals(mesh)),
          segments_(find_segments(mesh, normals_, angle)),
          taken_(segments_.all.size(), false) {}

    std::vector<ShapeFeature> run() {
        std::vector<ShapeFeature> features;
        for (std::uint32_t s = 0; s < segments_.all.size(); ++s) {
            if (taken_[s]) continue;
            if (std::optional<ShapeFeature> feature = feature_at(s)) features.push_back(*std::move(feature));
        }
        add_fillets(features);
        const auto first_face = [](const ShapeFeature& f) { return f.faces.front(); };
        std::sort(features.begin(), features.end(),
                  [&](const ShapeFeature& l, const ShapeFeature& r) { return first_face(l) < first_face(r); });
        for (std::uint32_t id = 0; id < features.size(); ++id) features[id].id = id;
        return features;
    }

private:
    const Vec3& point(HalfEdge h) const { return mesh_.positions[origin(mesh_, h)]; }

    /// Those that no other feature has a face of.
    void add_fillets(std::vector<ShapeFeature>& features) const {
        std::vector<bool> used(mesh_.faces.size(), false);
        const auto mark = [&](const ShapeFeature& feature) {
            for (const std::uint32_t f : feature.faces) used[f] = true;
        };
        for (const ShapeFeature& feature : features) mark(feature);
        for (ShapeFeature& fillet : find_fillets(mesh_, normals_, segments_.twin, angle_)) {
            if (std::any_of(fillet.faces.begin(), fillet.faces.end(), [&](std::uint32_t f) { return used[f]; })) continue;
            mark(fillet);
            features.push_back(std::move(fillet));
        }
    }

    std::optional<ShapeFeature> feature_at(std::uint32_t s) {
        const std::optional<Cylinder> cylinder = fit_cylinder(mesh_, normals_, segments_.all[s]);
        if (!cylinder) return {};
        chain_ = {s};
        radius_ = cylinder->radius;
        const std::vector<Loop>& loops = segments_.all[s].loops;
        std::array<End, 2> ends;
        for (std::size_t i = 0; i < 2; ++i)
            ends[i] = cylinder->inward ? follow(loops[i], *cylinder) : boss_end(loops[i], *cylinder);
        const int rims = (ends[0].rim ? 1 : 0) + (ends[1].rim ? 1 : 0);
        if (rims == 0 || (rims == 2 && !cylinder->inward)) return {};
        for (const End& end : ends) {
            if (end.rim && is_convex(*end.rim) != cylinder->inward) return {};
        }
        for (const std::uint32_t part : chain_) taken_[part] = true;
        const Kind kind = rims == 2 ? Kind::kThroughHole : (cylinder->inward ? Kind::kBlindHole : Kind::kBoss);
        return describe(kind, cylinder->axis, ends[0].rim ? *ends[0].rim : *ends[1].rim, rims == 2 ? ends[1].rim : nullptr);
    }

    /// Goes on from a border of an inward cylinder over chamfers and steps, to a bottom or a rim.
    End follow(const Loop& from, const Cylinder& cylinder) {
        const Loop* loop = &from;
        while (true) {
            const std::uint32_t s = segments_.across(*loop);
            if (s == kNone || in_chain(s)) return {loop};
            if (closes(s, cylinder.axis, *loop)) {
                chain_.push_back(s);
                return {};
            }
            const Loop* beyond = other_loop(s, *loop);
            if (!beyond || !is_inside(s, *beyond, cylinder.axis)) return {loop};
            chain_.push_back(s);
            if (const auto wider = fit_cylinder(mesh_, normals_, segments_.all[s])) radius_ = std::max(radius_, wider->radius);
            loop = beyond;
        }
    }

    End boss_end(const Loop& loop, const Cylinder& cylinder) {
        const std::uint32_t s = segments_.across(loop);
        if (s == kNone || !closes(s, cylinder.axis, loop)) return {&loop};
        chain_.push_back(s);
        return {};
    }

    bool in_chain(std::uint32_t s) const { return std::find(chain_.begin(), chain_.end(), s) != chain_.end(); }

    /// Whether a segment is a lid on this loop: nothing of it is further out.
    bool closes(std::uint32_t s, const Axis& axis, const Loop& loop) const {
        const Segments::Segment& segment = segments_.all[s];
        if (segment.loops.size() != 1) return false;
        double most = 0;
        for (const HalfEdge h : loop) most = std::max(most, axis.radial(point(h)).norm());
        return std::all_of(segment.faces.begin(), segment.faces.end(), [&](std::uint32_t f) {
            return std::all_of(mesh_.faces[f].begin(), mesh_.faces[f].end(), [&](std::uint32_t v) {
                return axis.radial(mesh_.positions[v]).norm() <= (1 + kRoundness) * most;
            });
        });
    }

    /// The border of a ring on the other side.
    const Loop* other_loop(std::uint32_t s, const Loop& loop) const {
        const std::vector<Loop>& loops = segments_.all[s].loops;
        if (loops.size() != 2) return nullptr;
        const HalfEdge shared = segments_.twin[loop.front()];
        const bool first = std::find(loops[0].begin(), loops[0].end(), shared) != loops[0].end();
        return first ? &loops[1] : &loops[0];
    }

    /// Whether a ring around the axis is the wall of a hole: it looks inwards, or is a step before a wall that does.
    bool is_inside(std::uint32_t s, const Loop& beyond, const Axis& axis) const {
        if (!is_circle_around(mesh_, beyond, axis)) return false;
        const double out = outwardness(segments_.all[s], axis);
        if (out < -kFlat) return true;
        if (out > kFlat) return false;
        const std::uint32_t next_wall = segments_.across(beyond);
        if (next_wall == kNone || in_chain(next_wall)) return false;
        const std::optional<Cylinder> wall = fit_cylinder(mesh_, normals_, segments_.all[next_wall]);
        return wall && wall->inward && std::abs(wall->axis.direction.dot(axis.direction)) > kParallel &&
               axis.radial(wall->axis.point).norm() < kRoundness * wall->radius;
    }

    /// Mean share of the normals away from the axis, -1..1.
    double outwardness(const Segments::Segment& segment, const Axis& axis) const {
        double sum = 0, area = 0;
        for (const std::uint32_t f : segment.faces) {
            const Triangle& t = mesh_.faces[f];
            const Vec3 &a = mesh_.positions[t[0]], &b = mesh_.positions[t[1]], &c = mesh_.positions[t[2]];
            const double size = (b - a).cross(c - a).norm();
            sum += size * axis.radial((a + b + c) / 3).normalized().dot(normals_.normals[f]);
            area += size;
        }
        return area > 0 ? sum / area : 0;
    }

    /// Whether the edges of a loop stick out, by length.
    bool is_convex(const Loop& loop) const {
        double out = 0;
        for (const HalfEdge h : loop) {
            const Vec3 &mine = normals_.normals[face_of(h)], &other = normals_.normals[face_of(segments_.twin[h])];
            out += mine.cross(other).dot(point(next(h)) - point(h));
        }
        return out > 0;
    }

    ShapeFeature describe(Kind kind, const Axis& axis, const Loop& rim, const Loop* other_rim) const {
        ShapeFeature feature;
        feature.kind = kind;
        feature.diameter = 2 * radius_;
        for (const std::uint32_t s : chain_) {
            const std::vector<std::uint32_t>& faces = segments_.all[s].faces;
            feature.faces.insert(feature.faces.end(), faces.begin(), faces.end());
        }
        std::sort(feature.faces.begin(), feature.faces.end());
        const double begin = axis.along(middle_of(mesh_, rim));
        const double end = other_rim ? axis.along(middle_of(mesh_, *other_rim)) : furthest(feature.faces, axis, begin);
        feature.depth = std::abs(end - begin);
        feature.axis = end < begin ? Vec3(-axis.direction) : axis.direction;
        feature.centre = axis.point + (begin + end) / 2 * axis.direction;
        return feature;
    }

    double furthest(const std::vector<std::uint32_t>& faces, const Axis& axis, double from) const {
        double far = from;
        for (const std::uint32_t f : faces) {
            for (const std::uint32_t v : mesh_.faces[f]) {
                const double here = axis.along(mesh_.positions[v]);
                if (std::abs(here - from) > std::abs(far - from)) far = here;
            }
        }
        return far;
    }

    const TriangleMesh& mesh_;
    const double angle_;
    const FaceNormals normals_;
    const Segments segments_;
    std::vector<bool> taken_;
    std::vector<std::uint32_t> chain_;  // of the feature under way
    double radius_ = 0;
};

}  // namespace

std::string_view shape_feature_name(ShapeFeature::Kind kind) {
    switch (kind) {
        case Kind::kThroughHole:
            return "THROUGH_HOLE";
        case Kind::kBlindHole:
            return "BLIND_HOLE";
        case Kind::kBoss:
            return "BOSS";
        case Kind::kFillet:
            return "FILLET";
    }
    return "";
}

Expected<std::vector<ShapeFeature>> list_features(const TriangleMesh& mesh, const FeatureSearch& search) {
    if (!(search.angle > 0 && search.angle < 180)) {
        return Error{Cause::kInvalidOption,
                     "angle is " + number_text(search.angle) + "; accepted are degrees over 0 and under 180", "angle"};
    }
    const MeshReport report = inspect(mesh);
    if (Status closed = require_closed_manifold(report); !closed) return closed.error();
    if (Status outward = require_outward(report); !outward) return outward.error();
    return Recogniser(mesh, search.angle).run();
}

}  // namespace vsplit

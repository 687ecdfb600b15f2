#include "vsplit/quality/slivers.h"

#include <algorithm>
#include <array>
#include <optional>

#include "base/number_text.h"
#include "features/mean_edge.h"
#include "quality/sliver_features.h"
#include "quality/sliver_mends.h"
#include "quality/sliver_source.h"
#include "vsplit/features/face_normals.h"
#include "vsplit/quality/stretch.h"

namespace vsplit {
namespace {

/// Of max_deviation: points along a crease that are so near have all between them within it.
constexpr double kCertainShare = 0.75;

constexpr std::array kCauses{SliverCause::kNarrowStrip, SliverCause::kSharpCorner, SliverCause::kCloseCorners,
                             SliverCause::kNarrowPart,  SliverCause::kDeviation,   SliverCause::kHeldByCreases,
                             SliverCause::kUnexplained};

double stretch_of_face(const TriangleMesh& mesh, std::uint32_t f) {
    const Triangle& t = mesh.faces[f];
    return stretch(mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]);
}

std::vector<std::uint32_t> slivers_of(const TriangleMesh& mesh) {
    std::vector<std::uint32_t> slivers;
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
        if (stretch_of_face(mesh, f) < kStretchFloor) slivers.push_back(f);
    }
    return slivers;
}

SliverFace describe(const TriangleMesh& mesh, std::uint32_t f, double edge) {
    const auto length = [&](HalfEdge h) {
        return (mesh.positions[origin(mesh, next(h))] - mesh.positions[origin(mesh, h)]).norm();
    };
    const std::array<HalfEdge, 3> sides{3 * f, 3 * f + 1, 3 * f + 2};
    const auto shorter = [&](HalfEdge a, HalfEdge b) { return length(a) < length(b); };
    SliverFace face;
    face.longest = *std::max_element(sides.begin(), sides.end(), shorter);
    face.shortest = *std::min_element(sides.begin(), sides.end(), shorter);
    face.length = length(face.longest);
    face.wanted = std::min(face.length, edge);
    face.stretch = stretch_of_face(mesh, f);
    return face;
}

/// A cause, and by how much.
struct Finding {
    SliverCause cause = SliverCause::kUnexplained;
    double value = 0;
};

/// `creaseless`: the same without creases to keep.
Finding find_cause(const MendedMesh& mended, const MendedMesh& creaseless, const SliverOptions& options, const SliverFace& face) {
    const SliverFeatures features(mended.mesh, mended.marks);
    if (const auto angle = features.sharp_corner(face)) return {SliverCause::kSharpCorner, *angle};
    if (const auto gap = features.narrow_strip(face)) return {SliverCause::kNarrowStrip, *gap};
    if (const auto distance = features.close_corners(face)) return {SliverCause::kCloseCorners, *distance};
    if (const auto girth = features.narrow_part(face)) return {SliverCause::kNarrowPart, *girth};
    if (!(options.max_deviation > 0)) return {SliverCause::kUnexplained, face.stretch};
    const std::optional<double> moved = least_mend(mended, face);
    const std::optional<double> at_least = moved ? moved : least_mend(creaseless, face);
    if (at_least && *at_least > options.max_deviation) return {SliverCause::kDeviation, *at_least};
    if (at_least && !moved) return {SliverCause::kHeldByCreases, face.stretch};
    return {SliverCause::kUnexplained, face.stretch};
}

std::string range(double least, double most) {
    return least == most ? number_text(least) : number_text(least) + " to " + number_text(most);
}

std::string message_of(const Slivers& s, double max_deviation) {
    const bool one = s.count == 1;
    std::string faces = std::to_string(s.count) + (one ? " face " : " faces ");
    const std::string values = range(s.least, s.most);
    switch (s.cause) {
        case SliverCause::kNarrowStrip:
            return faces + (one ? "lies" : "lie") + " between creases " + values + " apart";
        case SliverCause::kSharpCorner:
            return faces + (one ? "lies" : "lie") + " where two creases meet at " + values + " degrees";
        case SliverCause::kCloseCorners:
            return faces + (one ? "joins" : "join") + " corners of creases " + values + " apart";
        case SliverCause::kNarrowPart:
            return faces + (one ? "lies" : "lie") + " along a part of a girth of " + values;
        case SliverCause::kDeviation:
            return faces + (one ? "is" : "are") + " held by max_deviation, " + number_text(max_deviation) +
                   ": mending moves the surface by " + values;
        case SliverCause::kHeldByCreases:
            return faces + "of stretch " + values + (one ? " has" : " have") + " flips or collapses that would mend " +
                   (one ? "it" : "them") + ", and each takes a crease from where the source has one";
        case SliverCause::kUnexplained:
            return faces + "of stretch " + values + (one ? " is" : " are") +
                   " forced by no crease and no bound that was looked at";
    }
    return faces;
}

void add(Slivers& group, std::uint32_t face, double value) {
    if (group.count++ == 0) group.least = group.most = value;
    if (group.elements.size() < Slivers::kExamples) group.elements.push_back(face);
    group.least = std::min(group.least, value);
    group.most = std::max(group.most, value);
}

}  // namespace

std::string_view sliver_cause_name(SliverCause cause) {
    switch (cause) {
        case SliverCause::kNarrowStrip:
            return "NARROW_STRIP";
        case SliverCause::kSharpCorner:
            return "SHARP_CORNER";
        case SliverCause::kCloseCorners:
            return "CLOSE_CORNERS";
        case SliverCause::kNarrowPart:
            return "NARROW_PART";
        case SliverCause::kDeviation:
            return "DEVIATION";
        case SliverCause::kHeldByCreases:
            return "HELD_BY_CREASES";
        case SliverCause::kUnexplained:
            return "UNEXPLAINED";
    }
    return "";
}

namespace {

std::vector<Slivers> explain(const TriangleMesh& mesh, const std::vector<SharpEdge>& creases, const SliverOptions& options,
                             const SliverSource* source) {
    const std::vector<std::uint32_t> slivers = slivers_of(mesh);
    if (slivers.empty()) return {};
    const CreaseMarks none(mesh);
    CreaseMarks marks = none;
    marks.mark(creases);
    const FaceNormals normals = face_normals(mesh);
    const double edge = options.edge > 0 ? options.edge : mean_edge(mesh);
    MendedMesh mended{mesh, marks, normals, options.crease_angle};
    CreaseMarks bends = marks;
    std::optional<HeldCreases> held;
    if (source != nullptr && options.max_deviation > 0) {
        bends.mark(find_sharp_edges(mesh, normals, {.angle = kCreaseBendShare * options.crease_angle, .weight = 1}));
        mended.source = &source->surface;
        mended.creases = &held.emplace(mesh, bends, source->mesh, source->creases, kCertainShare * options.max_deviation);
    }
    constexpr double kAnyBend = 180;
    const MendedMesh creaseless{mesh, none, normals, kAnyBend, mended.source};
    std::array<Slivers, kCauses.size()> groups;
    for (const std::uint32_t f : slivers) {
        const Finding found = find_cause(mended, creaseless, options, describe(mesh, f, edge));
        add(groups[static_cast<std::size_t>(found.cause)], f, found.value);
    }
    std::vector<Slivers> explained;
    for (const SliverCause cause : kCauses) {
        Slivers& group = groups[static_cast<std::size_t>(cause)];
        if (group.count == 0) continue;
        group.cause = cause;
        group.message = message_of(group, options.max_deviation);
        explained.push_back(std::move(group));
    }
    return explained;
}

}  // namespace

std::vector<Slivers> explain_slivers(const TriangleMesh& mesh, const std::vector<SharpEdge>& creases,
                                     const SliverOptions& options) {
    return explain(mesh, creases, options, nullptr);
}

std::vector<Slivers> explain_slivers(const TriangleMesh& mesh, const std::vector<SharpEdge>& creases,
                                     const SliverOptions& options, const SliverSource& source) {
    return explain(mesh, creases, options, &source);
}

}  // namespace vsplit

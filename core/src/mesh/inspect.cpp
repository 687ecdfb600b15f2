#include "vsplit/mesh/inspect.h"

#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "base/for_each_in_parallel.h"
#include "base/huge_pages.h"
#include "mesh/disjoint_sets.h"
#include "mesh/half_edges.h"
#include "mesh/weld_findings.h"
#include "quality/quality_of_edges.h"
#include "vsplit/quality/stretch.h"

namespace vsplit {
namespace {

constexpr double kDegenerateStretch = 1e-9;

/// Counts things of one kind and keeps the first few places.
class FindingCounter {
public:
    explicit FindingCounter(Finding::Kind kind) { finding_.kind = kind; }

    void add(std::initializer_list<std::uint32_t> element) {
        if (finding_.count++ < Finding::kExamples) finding_.elements.insert(finding_.elements.end(), element);
    }
    [[nodiscard]] std::uint32_t count() const { return finding_.count; }

    /// `what` reads like "boundary edges (one face only)", `where` like "edge" or "face".
    void report(std::vector<Finding>& findings, std::string_view what, std::string_view where) {
        if (finding_.count == 0) return;
        finding_.message = std::to_string(finding_.count) + " " + std::string(what) + "; first at " + std::string(where) + " ";
        finding_.message += where == "edge" ? std::to_string(finding_.elements[0]) + "-" + std::to_string(finding_.elements[1])
                                            : std::to_string(finding_.elements[0]);
        findings.push_back(std::move(finding_));
    }

private:
    Finding finding_;
};

/// What edges tell: boundary, manifoldness, orientation, components.
struct EdgeSurvey {
    FindingCounter boundary{Finding::Kind::kBoundaryEdge};
    FindingCounter non_manifold{Finding::Kind::kNonManifoldEdge};
    FindingCounter inconsistent{Finding::Kind::kInconsistentEdge};
    std::uint32_t edges = 0;
    std::uint32_t components = 0;
};

EdgeSurvey survey_edges(const TriangleMesh& mesh, const EdgeIndex& edges) {
    EdgeSurvey survey;
    DisjointSets parts(mesh.faces.size());
    edges.for_each_edge([&](const EdgeIndex::Entry* first, const EdgeIndex::Entry* last) {
        ++survey.edges;
        for (const auto* other = first + 1; other != last; ++other)
            parts.join(face_of(first->half_edge), face_of(other->half_edge));
        if (last - first == 1) survey.boundary.add({first->a, first->b});
        if (last - first > 2) survey.non_manifold.add({first->a, first->b});
        if (last - first == 2 && origin(mesh, first[0].half_edge) == origin(mesh, first[1].half_edge)) {
            survey.inconsistent.add({first->a, first->b});
        }
    });
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) survey.components += parts.find(f) == f ? 1 : 0;
    return survey;
}

/// Corners joined across shared edges at the same vertex are one fan. For any mesh.
std::vector<std::uint8_t> vertices_of_several_fans(const TriangleMesh& mesh, const EdgeIndex& edges) {
    DisjointSets fans(mesh.faces.size() * 3);
    const auto corner_at = [&](HalfEdge h, std::uint32_t vertex) { return origin(mesh, h) == vertex ? h : next(h); };
    edges.for_each_edge([&](const EdgeIndex::Entry* first, const EdgeIndex::Entry* last) {
        for (const auto* other = first + 1; other != last; ++other) {
            fans.join(corner_at(first->half_edge, first->a), corner_at(other->half_edge, first->a));
            fans.join(corner_at(first->half_edge, first->b), corner_at(other->half_edge, first->b));
        }
    });
    std::vector<std::uint32_t> fan_of(mesh.positions.size(), kNone);
    std::vector<std::uint8_t> several(mesh.positions.size(), 0);
    for (HalfEdge h = 0; h < mesh.faces.size() * 3; ++h) {
        const std::uint32_t v = origin(mesh, h);
        const std::uint32_t fan = fans.find(h);
        if (fan_of[v] == kNone) fan_of[v] = fan;
        if (fan_of[v] != fan) several[v] = 1;
    }
    return several;
}

/// Corners that a walk around the vertex of one of them comes by; across the edges of `twins` there is one way to go.
std::uint32_t corners_in_fan(const std::vector<HalfEdge>& twins, HalfEdge corner) {
    std::uint32_t count = 1;
    HalfEdge h = twins[prev(corner)];
    for (; h != kNone && h != corner; h = twins[prev(h)]) ++count;
    if (h == corner) return count;
    for (h = twins[corner]; h != kNone; h = twins[next(h)]) ++count;  // it is open: the other way too
    return count;
}

/// The same where all is regular, by a walk around each vertex.
std::vector<std::uint8_t> vertices_of_several_fans_in_regular(const TriangleMesh& mesh, const EdgeIndex& edges) {
    const std::vector<HalfEdge> twins = half_edge_twins(mesh, edges);
    auto corner = large_vector<HalfEdge>(mesh.positions.size(), kNone);
    auto corners = large_vector<std::uint32_t>(mesh.positions.size());
    for (HalfEdge h = 0; h < twins.size(); ++h) {
        corner[origin(mesh, h)] = h;
        ++corners[origin(mesh, h)];
    }
    std::vector<std::uint8_t> several(mesh.positions.size(), 0);
    for_each_in_parallel(mesh.positions.size(), [&](std::size_t v) {
        several[v] = corners[v] > 0 && corners_in_fan(twins, corner[v]) < corners[v] ? 1 : 0;
    });
    return several;
}

/// Whether every edge is a boundary or has two faces that agree on which side is outside.
bool is_regular(const TriangleMesh& mesh, const EdgeIndex& edges) {
    bool regular = true;
    edges.for_each_edge([&](const EdgeIndex::Entry* first, const EdgeIndex::Entry* last) {
        regular &=
            last - first == 1 || (last - first == 2 && origin(mesh, first[0].half_edge) != origin(mesh, first[1].half_edge));
    });
    return regular;
}

/// Vertices whose faces form more than one fan around them.
FindingCounter survey_vertices(const TriangleMesh& mesh, const EdgeIndex& edges, bool regular) {
    const std::vector<std::uint8_t> several =
        regular ? vertices_of_several_fans_in_regular(mesh, edges) : vertices_of_several_fans(mesh, edges);
    FindingCounter counter(Finding::Kind::kNonManifoldVertex);
    for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
        if (several[v] != 0) counter.add({v});
    }
    return counter;
}

FindingCounter survey_degenerate(const TriangleMesh& mesh) {
    std::vector<std::uint8_t> degenerate(mesh.faces.size());
    for_each_in_parallel(mesh.faces.size(), [&](std::size_t f) {
        const Triangle& t = mesh.faces[f];
        degenerate[f] = stretch(mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]) < kDegenerateStretch ? 1 : 0;
    });
    FindingCounter counter(Finding::Kind::kDegenerateFace);
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
        if (degenerate[f] != 0) counter.add({f});
    }
    return counter;
}

/// Faces with the same three vertices as an earlier one. They share their edge of the two smallest, and its third vertex.
FindingCounter survey_duplicates(const TriangleMesh& mesh, const EdgeIndex& edges) {
    std::vector<std::uint32_t> repeats;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> third;  // and the face
    edges.for_each_edge([&](const EdgeIndex::Entry* first, const EdgeIndex::Entry* last) {
        third.clear();
        for (const auto* entry = first; entry != last; ++entry) {
            const std::uint32_t opposite = origin(mesh, prev(entry->half_edge));
            if (opposite >= first->b) third.emplace_back(opposite, face_of(entry->half_edge));
        }
        if (third.size() < 2) return;
        std::sort(third.begin(), third.end());
        third.erase(std::unique(third.begin(), third.end()), third.end());  // a face may have an edge twice
        for (std::size_t i = 1; i < third.size(); ++i) {
            if (third[i].first == third[i - 1].first) repeats.push_back(third[i].second);
        }
    });
    std::sort(repeats.begin(), repeats.end());
    FindingCounter counter(Finding::Kind::kDuplicateFace);
    for (const std::uint32_t f : repeats) counter.add({f});
    return counter;
}

/// Of vertices with several fans those where two are open: each open one has two boundary edges.
std::vector<std::uint32_t> survey_touches(const TriangleMesh& mesh, const EdgeIndex& edges, const FindingCounter& several) {
    std::vector<std::uint32_t> touches;
    if (several.count() == 0) return touches;
    std::vector<std::uint32_t> ends(mesh.positions.size(), 0);
    edges.for_each_edge([&](const EdgeIndex::Entry* first, const EdgeIndex::Entry* last) {
        if (last - first != 1) return;
        ++ends[first->a];
        ++ends[first->b];
    });
    for (std::uint32_t v = 0; v < mesh.vertex_count() && touches.size() < Finding::kExamples; ++v) {
        if (ends[v] >= 4) touches.push_back(v);
    }
    return touches;
}

std::uint32_t used_vertices(const TriangleMesh& mesh) {
    std::vector<bool> used(mesh.positions.size(), false);
    for (const Triangle& f : mesh.faces) {
        for (const std::uint32_t v : f) used[v] = true;
    }
    return static_cast<std::uint32_t>(std::count(used.begin(), used.end(), true));
}

const Finding* find_kind(const MeshReport& report, Finding::Kind kind) {
    const auto found =
        std::find_if(report.findings.begin(), report.findings.end(), [&](const Finding& f) { return f.kind == kind; });
    return found == report.findings.end() ? nullptr : &*found;
}

/// "edges 1-2, 3-4, 5-6, ..." or "vertices 1, 2, ...": where to look, a handful of them.
std::string places(const Finding& finding, bool edges) {
    constexpr std::size_t kShown = 5;
    const std::size_t stride = edges ? 2 : 1;
    std::string text = edges ? "edges " : "vertices ";
    for (std::size_t i = 0; i < std::min<std::size_t>(kShown, finding.count) && (i + 1) * stride <= finding.elements.size();
         ++i) {
        if (i > 0) text += ", ";
        text += std::to_string(finding.elements[i * stride]);
        if (edges) text += "-" + std::to_string(finding.elements[i * stride + 1]);
    }
    return finding.count > kShown ? text + ", ..." : text;
}

}  // namespace

namespace {

/// Beyond what rounding makes of a sheet folded onto itself. \pre closed.
bool looks_inwards(const TriangleMesh& mesh, const BoundingBox& box) {
    constexpr double kRounding = 1e-9;
    const double volume = enclosed_volume(mesh);
    return volume < 0 && volume < -kRounding * surface_area(mesh) * box.diagonal();
}

/// Where the examples of a finding are.
void add_places(const TriangleMesh& mesh, Finding& finding) {
    const bool of_edges = finding.kind <= Finding::Kind::kInconsistentEdge;
    const bool of_faces = finding.kind == Finding::Kind::kDegenerateFace || finding.kind == Finding::Kind::kDuplicateFace ||
                          finding.kind == Finding::Kind::kInsideOut;
    const std::vector<std::uint32_t>& e = finding.elements;
    for (std::size_t i = 0; i < e.size(); i += of_edges ? 2 : 1) {
        Vec3 place = Vec3::Zero();
        if (of_edges) {
            place = (mesh.positions[e[i]] + mesh.positions[e[i + 1]]) / 2;
        } else if (of_faces) {
            for (const std::uint32_t v : mesh.faces[e[i]]) place += mesh.positions[v] / 3;
        } else {
            place = mesh.positions[e[i]];
        }
        finding.places.push_back(place);
    }
}

}  // namespace

MeshReport inspect(const TriangleMesh& mesh, const WeldCounts& weld) {
    MeshReport report;
    report.vertices = mesh.vertex_count();
    report.faces = mesh.face_count();
    const EdgeIndex index(mesh);
    EdgeSurvey edges;
    FindingCounter vertices(Finding::Kind::kNonManifoldVertex), degenerate(Finding::Kind::kDegenerateFace),
        duplicates(Finding::Kind::kDuplicateFace);
    std::uint32_t used = 0;
    bool inwards = false;  // if it is closed
    // Each looks at the mesh and writes what is its own.
    tbb::parallel_invoke([&] { vertices = survey_vertices(mesh, index, is_regular(mesh, index)); },
                         [&] { edges = survey_edges(mesh, index); }, [&] { duplicates = survey_duplicates(mesh, index); },
                         [&] { report.quality = measure_quality(mesh, index); },
                         [&] {
                             report.box = bounding_box(mesh);
                             inwards = looks_inwards(mesh, report.box);
                         },
                         [&] { used = used_vertices(mesh); }, [&] { report.groups = list_groups(mesh); });
    if (report.quality.stretch_min < kDegenerateStretch) degenerate = survey_degenerate(mesh);
    report.boundary_touches = survey_touches(mesh, index, vertices);
    report.components = edges.components;
    report.boundary_edges = edges.boundary.count();
    report.non_manifold_edges = edges.non_manifold.count();
    report.inconsistent_edges = edges.inconsistent.count();
    report.non_manifold_vertices = vertices.count();
    report.degenerate_faces = degenerate.count();
    report.duplicate_faces = duplicates.count();
    const bool manifold =
        report.non_manifold_edges + report.inconsistent_edges + report.non_manifold_vertices + report.duplicate_faces == 0;
    report.closed = manifold && report.boundary_edges == 0 && report.faces > 0;
    if (report.closed) {
        const std::int64_t euler = std::int64_t{used} - edges.edges + report.faces;
        report.genus = static_cast<std::int32_t>(report.components - euler / 2);
    }

    edges.boundary.report(report.findings, "boundary edges (one face only)", "edge");
    edges.non_manifold.report(report.findings, "non-manifold edges (more than two faces)", "edge");
    edges.inconsistent.report(report.findings, "edges whose two faces run along them in the same direction", "edge");
    vertices.report(report.findings, "non-manifold vertices (more than one fan of faces)", "vertex");
    degenerate.report(report.findings, "degenerate faces (stretch under 1e-9)", "face");
    duplicates.report(report.findings, "faces with the same three vertices as an earlier one", "face");
    if (report.closed && inwards) {
        FindingCounter counter(Finding::Kind::kInsideOut);
        for (std::uint32_t f = 0; f < mesh.face_count(); ++f) counter.add({f});
        counter.report(report.findings, "faces look inwards: the mesh is inside out", "face");
    }
    for (Finding& finding : report.findings) add_places(mesh, finding);
    const std::vector<Finding> welded = weld_findings(weld);
    report.findings.insert(report.findings.end(), welded.begin(), welded.end());
    return report;
}

namespace {

/// What to do, for who has the file still.
constexpr const char* kRepairHelps = "; a repair when the mesh is read mends that";

constexpr const char* kFullRepairHelps = "; a full repair when the mesh is read mends that";

Status require_faces_and_edges(const MeshReport& report) {
    if (report.faces == 0) return Error{Cause::kEmptyInput, "the mesh has no faces; at least one is needed", ""};
    using Kind = Finding::Kind;
    if (const Finding* f = find_kind(report, Kind::kNonManifoldEdge)) {
        return Error{Cause::kNonManifold,
                     std::to_string(f->count) + " edges have more than two faces: " + places(*f, true) +
                         " (vertex indices); every edge must have two, or one at a boundary" + kRepairHelps,
                     ""};
    }
    if (const Finding* f = find_kind(report, Kind::kInconsistentEdge)) {
        return Error{Cause::kNonManifold,
                     std::to_string(f->count) + " edges have two faces that disagree on which side is outside: " +
                         places(*f, true) + " (vertex indices); faces must be oriented consistently" + kRepairHelps,
                     ""};
    }
    if (const Finding* f = find_kind(report, Kind::kDuplicateFace)) {
        return Error{Cause::kNonManifold,
                     std::to_string(f->count) +
                         " of the faces lie on the same three vertices as another one, the first is face " +
                         std::to_string(f->elements.front()) + "; a sheet needs a thickness, or one face only" + kRepairHelps,
                     ""};
    }
    return Done{};
}

/// "7" or "7, 8, 9, ...".
std::string list(const std::vector<std::uint32_t>& numbers) {
    constexpr std::size_t kShown = 5;
    std::string text;
    for (std::size_t i = 0; i < std::min(kShown, numbers.size()); ++i) text += (i > 0 ? ", " : "") + std::to_string(numbers[i]);
    return numbers.size() > kShown ? text + ", ..." : text;
}

Status require_vertices(const MeshReport& report) {
    if (!report.boundary_touches.empty()) {
        return Error{Cause::kNonManifold,
                     "the boundary touches itself at vertex " + list(report.boundary_touches) +
                         "; accepted is a boundary that passes every vertex at most once: give each part a vertex of its own, or "
                         "fill the gap between them" +
                         kRepairHelps,
                     ""};
    }
    if (const Finding* f = find_kind(report, Finding::Kind::kNonManifoldVertex)) {
        return Error{Cause::kNonManifold,
                     std::to_string(f->count) + " vertices join more than one fan of faces: " + places(*f, false) +
                         "; every vertex must have one" + kRepairHelps,
                     ""};
    }
    return Done{};
}

}  // namespace

Status require_closed_manifold(const MeshReport& report) {
    if (Status edges = require_faces_and_edges(report); !edges) return edges;
    if (const Finding* f = find_kind(report, Finding::Kind::kBoundaryEdge)) {
        return Error{Cause::kOpenMesh,
                     "the mesh is open: " + std::to_string(f->count) + " edges have one face only: " + places(*f, true) +
                         " (vertex indices); a closed mesh is needed; a weld or a full repair when the mesh is read may close it",
                     ""};
    }
    return require_vertices(report);
}

Status require_outward(const MeshReport& report) {
    if (find_kind(report, Finding::Kind::kInsideOut) == nullptr) return Done{};
    return Error{Cause::kNonManifold,
                 "the mesh is inside out: its faces look inwards; faces must look outwards" + std::string(kFullRepairHelps), ""};
}

Status require_manifold(const MeshReport& report) {
    if (Status edges = require_faces_and_edges(report); !edges) return edges;
    return require_vertices(report);
}

}  // namespace vsplit

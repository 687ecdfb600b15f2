#include "cli/report.h"

#include <algorithm>
#include <string_view>

#include "cli/message.h"
#include "cli/number_text.h"
#include "vsplit/mrr/record_block.h"
#include "vsplit/quality/stretch.h"

namespace vsplit::cli {
namespace {

constexpr std::size_t kNameWidth = 18;
constexpr std::size_t kBarWidth = 40;

std::string line(const std::string& name, const std::string& value) { return left(name, kNameWidth) + value + "\n"; }

std::string point(const v1::Vector& p) { return "(" + figure(p.x()) + ", " + figure(p.y()) + ", " + figure(p.z()) + ")"; }

std::string share(std::uint64_t part, std::uint64_t whole) {
    return whole == 0 ? "" : " (" + fixed(100 * static_cast<double>(part) / static_cast<double>(whole), 2) + " %)";
}

/// `unit`, here and below: what stands behind a length.
std::string quality_lines(const v1::Quality& q, const std::string& unit) {
    std::string text = line("stretch mean", fixed(q.stretch_mean(), 4));
    text += line("stretch min", fixed(q.stretch_min(), 4));
    text += line("stretch 1 %", fixed(q.stretch_p01(), 4));
    text += line("stretch < 0.2", counted(q.faces_below_02(), "face", "faces") + share(q.faces_below_02(), q.faces()));
    text += line("longest edge", figure(q.size_max()) + unit);
    text += line("largest valence", grouped(q.valence_max()));
    if (q.has_deviation_max()) text += line("deviation", figure(q.deviation_max()) + unit);
    if (q.has_crease_deviation_max()) text += line("crease deviation", figure(q.crease_deviation_max()) + unit);
    return text;
}

std::string histogram_line(double from, double to, std::uint32_t count, std::uint32_t most) {
    const std::size_t length = most == 0 ? 0 : (std::size_t{count} * kBarWidth + most - 1) / most;  // a face is never invisible
    return "  " + fixed(from, 2) + "-" + fixed(to, 2) + " |" + left(std::string(length, '#'), kBarWidth) +
           right(grouped(count), 12) + "\n";
}

std::string histogram(const v1::Quality& q) {
    const auto& counts = q.stretch_histogram();
    if (counts.empty()) return {};
    const std::uint32_t most = *std::max_element(counts.begin(), counts.end());
    const double width = 1.0 / counts.size();
    std::string text = "\nstretch            faces\n";
    for (int i = 0; i < counts.size(); ++i) {
        const double from = i * width;
        if (i > 0 && std::abs(from - kStretchFloor) < width / 2)
            text += "  ---- 0.2 -- solvers want no face above this line ----\n";
        text += histogram_line(from, from + width, counts[i], most);
    }
    return text;
}

/// The head of a column of lengths: "size, mm".
std::string headed(const std::string& name, const std::string& unit) { return unit.empty() ? name : name + "," + unit; }

std::string worst_faces(const v1::Quality& q, const std::string& unit) {
    if (q.worst_faces().empty()) return {};
    std::string text = "\n" + right("worst face", 12) + right("stretch", 12) + right(headed("size", unit), 12) + "  " +
                       headed("centroid", unit) + "\n";
    for (const v1::FaceQuality& face : q.worst_faces()) {
        text += right(std::to_string(face.face()), 12) + right(fixed(face.stretch(), 6), 12) + right(figure(face.size()), 12) +
                "  " + point(face.centroid()) + "\n";
    }
    return text;
}

/// How the mesh does by a profile: a line for each of its figures, and the faces to look at.
std::string profile_lines(const v1::ProfileReport& p) {
    std::string text = "\nby " + v1::QualityProfile_Name(p.profile()) + ": " + counted(p.passed(), "face passes", "faces pass") +
                       ", " + grouped(p.warned()) + " with a warning, " + grouped(p.failed()) + " fail\n";
    text += left("figure", kNameWidth) + right("worst", 12) + right("face", 12) + right("warning", 12) + right("faces", 12) +
            right("failure", 12) + right("faces", 12) + "\n";
    for (const v1::CriterionReport& c : p.criteria()) {
        const std::string beyond = c.upper() ? "> " : "< ";
        const bool warns = c.warn_limit() != c.fail_limit();
        text += left(c.name(), kNameWidth) + right(figure(c.worst()), 12) + right(std::to_string(c.worst_face()), 12) +
                right(warns ? beyond + figure(c.warn_limit()) : "-", 12) + right(grouped(c.warned()), 12) +
                right(beyond + figure(c.fail_limit()), 12) + right(grouped(c.failed()), 12) + "\n";
    }
    if (p.worst_faces().empty()) return text;
    text += "worst faces:";
    for (const std::uint32_t face : p.worst_faces()) text += " " + std::to_string(face);
    return text + "\n";
}

std::string details(const v1::Quality& q, bool detailed, const std::string& unit) {
    if (!detailed) return {};
    return histogram(q) + worst_faces(q, unit) + (q.has_profile() ? profile_lines(q.profile()) : std::string());
}

std::string group_text(const v1::FaceGroup& group) {
    std::string regions;
    for (const std::uint32_t region : group.regions()) regions += (regions.empty() ? "" : ", ") + std::to_string(region);
    const std::string faces = counted(group.faces(), "face", "faces");
    if (group.name().empty()) return "region " + regions + ": " + faces;
    return printable(group.name()) + ": " + faces + (group.regions_size() == 1 ? ", region " : ", regions ") + regions;
}

/// A line for each of the first groups of a mesh.
template <class Described>
std::string group_lines(const Described& described) {
    constexpr int kShown = 20;
    std::string text;
    for (int i = 0; i < std::min(kShown, described.groups_size()); ++i) text += line("group", group_text(described.groups(i)));
    if (described.group_count() > kShown)
        text += line("groups", grouped(described.group_count()) + " in all; --json lists up to 100");
    return text;
}

std::string closed_or_why(const v1::MeshSummary& m) {
    if (m.closed()) return "yes";
    if (m.boundary_edges() == 0) return "no, not manifold";
    return "no, " + counted(m.boundary_edges(), "boundary edge", "boundary edges");
}

std::string text_of(const v1::MeshSummary& m, bool detailed, const std::string& unit) {
    std::string text = line("faces", grouped(m.faces()));
    text += line("vertices", grouped(m.vertices()));
    text += line("unit", unit.empty() ? "not known" : unit.substr(1));
    text += line("closed", closed_or_why(m));
    text += line("components", grouped(m.components()));
    if (m.closed()) text += line("genus", std::to_string(m.genus()));
    if (m.bounding_box().has_min())
        text += line("box", point(m.bounding_box().min()) + " to " + point(m.bounding_box().max()) + unit);
    text += quality_lines(m.quality(), unit);
    text += group_lines(m);
    for (const v1::Finding& finding : m.findings()) text += line("finding", finding.kind() + ": " + printable(finding.message()));
    return text + details(m.quality(), detailed, unit);
}

std::string method_name(v1::Method method) {
    switch (method) {
        case v1::IMPROVE:
            return "improve";
        case v1::CONTROL:
            return "control";
        default:
            return "not recorded";
    }
}

double seconds(const google::protobuf::Duration& d) { return static_cast<double>(d.seconds()) + d.nanos() * 1e-9; }

template <class Options>
std::string common_options(const Options& o, const std::string& unit) {
    std::string text = line("tolerance", figure(o.tolerance()) + unit);
    if (o.has_max_deviation()) text += line("max deviation", figure(o.max_deviation()) + unit);
    text += line("feature angle", figure(o.feature_angle()) + " degrees");
    text += line("feature weight", figure(o.feature_weight()));
    return text;
}

std::string option_lines(const v1::Representation& r, const std::string& unit) {
    if (r.has_improve_options()) {
        const v1::ImproveOptions& o = r.improve_options();
        std::string text = line("subdivided to", figure(o.subdivision_size()) + unit);
        if (o.min_stretch() > 0) text += line("least stretch", figure(o.min_stretch()));
        if (o.min_mean_stretch() > 0) text += line("least mean", figure(o.min_mean_stretch()));
        return text + common_options(o, unit);
    }
    if (!r.has_control_options()) return {};
    const v1::ControlOptions& o = r.control_options();
    std::string text = line("subdivisions", std::to_string(o.subdivisions()));
    text += line("least stretch", figure(o.min_stretch()));
    if (o.has_max_size()) text += line("size bound", figure(o.max_size()) + unit);
    if (o.has_max_valence()) text += line("valence bound", std::to_string(o.max_valence()));
    if (o.has_min_angle()) text += line("least angle", figure(o.min_angle()) + " degrees");
    if (o.has_max_angle()) text += line("largest angle", figure(o.max_angle()) + " degrees");
    if (o.has_max_aspect_ratio()) text += line("aspect bound", figure(o.max_aspect_ratio()));
    if (o.has_min_size()) text += line("least size", figure(o.min_size()) + unit);
    return text + common_options(o, unit);
}

std::string bounds_line(const v1::Representation& r, const std::string& unit) {
    if (r.bounds_satisfied()) return r.method() == v1::CONTROL ? line("bounds", "all hold") : std::string();
    std::string broken;
    for (const v1::Violation& v : r.violations()) {
        broken += (broken.empty() ? "" : "; ") + v.bound() + " broken by " + broken_by(v) + ", worst " +
                  figure_of_bound(v, v.worst(), unit);
    }
    return line("bounds", broken);
}

/// How large the stream of records is, and what of it each kind takes.
std::string records_line(const v1::RecordCounts& r) {
    if (r.splits() == 0) return {};
    const auto per_split = [&](std::uint32_t count, RecordKind kind) {
        return static_cast<double>(count) * static_cast<double>(record_bytes(kind)) / r.splits();
    };
    const double splits = per_split(r.splits(), RecordKind::kSplit);
    const double flips = per_split(r.flips(), RecordKind::kFlip);
    const double moves = per_split(r.moves(), RecordKind::kMove);
    return line("records", counted(r.splits(), "split", "splits") + ", " + counted(r.flips(), "flip", "flips") + ", " +
                               counted(r.moves(), "move", "moves")) +
           line("bytes a split", fixed(splits + flips + moves, 1) + " (" + fixed(splits, 0) + " + " + fixed(flips, 1) +
                                     " of flips + " + fixed(moves, 1) + " of moves)");
}

std::string text_of(const v1::Representation& r, bool detailed, const std::string& unit) {
    std::string text;
    if (!r.id().empty()) text += line("representation", r.id());
    text += line("method", method_name(r.method()));
    text += line("faces", grouped(r.faces()) + " (" + grouped(r.faces_min()) + " to " + grouped(r.faces_max()) + " at hand)");
    text += option_lines(r, unit) + quality_lines(r.quality(), unit) + bounds_line(r, unit) + records_line(r.records()) +
            group_lines(r);
    if (r.has_elapsed()) text += line("time", fixed(seconds(r.elapsed()), 2) + " s");
    for (const v1::Slivers& slivers : r.slivers()) text += line("slivers", slivers.message());
    return text + details(r.quality(), detailed, unit);
}

std::string kind_name(v1::ShapeFeature::Kind kind) {
    switch (kind) {
        case v1::ShapeFeature::THROUGH_HOLE:
            return "through hole";
        case v1::ShapeFeature::BLIND_HOLE:
            return "blind hole";
        case v1::ShapeFeature::BOSS:
            return "boss";
        case v1::ShapeFeature::FILLET:
            return "fillet";
        default:
            return "unknown";
    }
}

std::string text_of(const v1::ListFeaturesResponse& list, bool /*detailed*/, const std::string& unit) {
    if (list.features().empty()) return "no round hole, boss or fillet is recognised\n";
    std::string text = right("id", 6) + "  " + left("kind", 14) + right(headed("diameter", unit), 12) +
                       right(headed("depth", unit), 12) + right("faces", 8) + "  " + headed("centre", unit) + "; axis\n";
    for (const v1::ShapeFeature& f : list.features()) {
        text += right(std::to_string(f.id()), 6) + "  " + left(kind_name(f.kind()), 14) + right(figure(f.diameter()), 12) +
                right(figure(f.depth()), 12) + right(grouped(f.face_count()), 8) + "  " + point(f.centre()) + "; " +
                point(f.axis()) + "\n";
    }
    return text;
}

std::string text_of(const v1::RemoveFeaturesResponse& done, bool detailed, const std::string& unit) {
    std::string text = line("removed", counted(static_cast<std::uint64_t>(done.removed_size()), "feature", "features"));
    text +=
        line("new faces", grouped(done.source().faces() - done.first_new_face()) + ", from " +
                              std::to_string(done.first_new_face()) + " on, aimed at a size of " + figure(done.size()) + unit);
    for (const v1::KeptFeature& kept : done.kept()) text += line("kept", std::to_string(kept.id()) + ": " + kept.reason());
    return text + text_of(done.source(), detailed, unit);
}

/// Both bounds, and the upper one as a share of the diagonal.
std::string bounds_text(const DirectedDeviation& d, double diagonal, const std::string& unit) {
    const std::string share_of_diagonal = diagonal > 0 ? " (" + fixed(100 * d.upper / diagonal, 4) + " % of the diagonal)" : "";
    return figure(d.lower) + " to " + figure(d.upper) + unit + share_of_diagonal;
}

std::string text_of(const Comparison& c, bool /*detailed*/, const std::string& unit) {
    std::string text = line("faces", grouped(c.faces) + " against " + grouped(c.faces_against));
    text += line("diagonal", figure(c.diagonal) + unit);
    text += line("to source", bounds_text(c.surface.to_source, c.diagonal, unit));
    text += line("from source", bounds_text(c.surface.from_source, c.diagonal, unit));
    text += line("crease edges", grouped(c.creases.result_creases) + " against " + grouped(c.creases.source_creases));
    if (c.creases.source_creases == 0) return text;
    if (c.creases.result_creases == 0) return text + line("creases", "none is kept");
    text += line("creases", bounds_text(c.creases.from_source, c.diagonal, unit));
    return text + line("creases lost", fixed(100 * c.creases.lost, 2) + " % of their length");
}

}  // namespace

std::string report(const Document& document, bool detailed) {
    const std::string unit = unit_suffix(unit_of(document));
    return std::visit([&](const auto& d) { return text_of(d, detailed, unit); }, document);
}

std::string written_lines(const std::vector<std::string>& files) {
    std::string text;
    for (const std::string& file : files) text += line("written", file);
    return text;
}

}  // namespace vsplit::cli

#include "cli/message.h"

#include <algorithm>
#include <map>
#include <string_view>

#include "cli/arguments.h"
#include "cli/number_text.h"
#include "cli/outcome.h"
#include "vsplit/io/write_losses.h"
#include "wire/features.h"
#include "wire/utf8.h"

namespace vsplit::cli {
namespace {

/// The option that fills a field; empty where there is none. Fields are named in the contract, options on the command line.
std::string option_of(const std::string& field) {
    static const std::map<std::string_view, std::string_view> options{{"subdivision_size", "--subdivide"},
                                                                      {"tolerance", "--tolerance"},
                                                                      {"max_deviation", "--max-deviation"},
                                                                      {"feature_angle", "--feature-angle"},
                                                                      {"feature_weight", "--feature-weight"},
                                                                      {"faces", "--faces"},
                                                                      {"faces_min", "--faces-min"},
                                                                      {"mode", "--mode"},
                                                                      {"subdivisions", "--subdivisions"},
                                                                      {"min_stretch", "--min-stretch"},
                                                                      {"min_mean_stretch", "--min-mean-stretch"},
                                                                      {"max_size", "--max-size"},
                                                                      {"max_valence", "--max-valence"},
                                                                      {"min_angle", "--min-angle"},
                                                                      {"max_angle", "--max-angle"},
                                                                      {"max_aspect_ratio", "--max-aspect-ratio"},
                                                                      {"min_size", "--min-size"},
                                                                      {"feature_detection", "--feature-detection"},
                                                                      {"freeze_boundary", "--freeze-boundary"},
                                                                      {"sizing.spheres", "--size-sphere"},
                                                                      {"sizing.boxes", "--size-box"},
                                                                      {"sizing.chord_error", "--chord-error"},
                                                                      {"sizing.field", "--size-field"},
                                                                      {"size_field", "--size-field"},
                                                                      {"sizing.gradation", "--gradation"},
                                                                      {"sizing.min_size", "--min-size"},
                                                                      {"weld", "--weld"},
                                                                      {"repair", "--repair"},
                                                                      {"stitch", "--stitch"},
                                                                      {"hole_size", "--hole-size"},
                                                                      {"speck_size", "--speck-size"},
                                                                      {"unit", "--unit"},
                                                                      {"format", "--format"},
                                                                      {"order", "--order"},
                                                                      {"server", "--server"},
                                                                      {"session", "--session"},
                                                                      {"tls_ca", "--tls-ca"},
                                                                      {"tls_cert", "--tls-cert"},
                                                                      {"tls_key", "--tls-key"},
                                                                      {"token_file", "--token-file"},
                                                                      {"representation", "--representation"},
                                                                      {"keep", "--keep"},
                                                                      {"source_faces", "--source-faces"},
                                                                      {"output", "-o"},
                                                                      {"angle", "--angle"},
                                                                      {"ids", "--id"},
                                                                      {"max_diameter", "--max-diameter"},
                                                                      {"kinds", "--kind"},
                                                                      {"input", "IN"}};
    const auto found = options.find(field);
    return found == options.end() ? std::string() : std::string(found->second);
}

/// The options that do what the engine says in its own words; empty where it says nothing of the kind.
std::string_view help_of(Cause cause) {
    if (cause == Cause::kNonManifold) return "--repair safe|full";
    if (cause == Cause::kOpenMesh) return "--weld T, --repair full";
    return {};
}

/// The first few of what breaks a bound.
std::string named(const v1::Violation& violation) {
    constexpr int kNamed = 5;
    if (violation.elements_size() == 0) return {};
    std::string text;
    for (int i = 0; i < std::min(kNamed, violation.elements_size()); ++i) {
        text += (i == 0 ? " (" : ", ") + std::to_string(violation.elements(i));
    }
    return text + (violation.count() > kNamed ? ", ...)" : ")");
}

}  // namespace

std::string printable(std::string_view text) {
    std::string shown = wire::valid_utf8(text, text.size() + 3);
    std::replace_if(
        shown.begin(), shown.end(), [](char c) { return (c >= 0 && c < ' ') || c == 0x7F; }, '?');
    return shown;
}

std::string error_message(const Error& error) {
    if (error.cause == Cause::kCancelled) return "vsplit: cancelled\n";
    std::string text = "vsplit: " + std::string(cause_name(error.cause)) + ": " + printable(error.message);
    const std::string option = option_of(error.field);
    const std::string_view help = option.empty() ? help_of(error.cause) : option;
    if (!help.empty()) text.append(" (").append(help).append(")");
    return text + "\n";
}

std::string broken_by(const v1::Violation& violation) {
    if (violation.bound() == "max_deviation") return "the surface";
    const bool vertices = violation.bound() == "max_valence";
    return vertices ? counted(violation.count(), "vertex", "vertices") : counted(violation.count(), "face", "faces");
}

std::string unit_suffix(std::optional<LengthUnit> unit) { return unit ? " " + std::string(unit_symbol(*unit)) : std::string(); }

std::string figure_of_bound(const v1::Violation& violation, double value, const std::string& unit) {
    const std::string& bound = violation.bound();
    const bool length = bound == "max_size" || bound == "min_size" || bound == "max_deviation";
    return figure(value) + (length ? unit : std::string());
}

std::string violation_messages(const v1::Representation& made) {
    const std::string unit = unit_suffix(unit_of(made));
    std::string text;
    for (const v1::Violation& violation : made.violations()) {
        text += "vsplit: bound not met: " + violation.bound() + " " + figure_of_bound(violation, violation.limit(), unit) + ": " +
                broken_by(violation) + named(violation) + ", worst " + figure_of_bound(violation, violation.worst(), unit) +
                "; " + violation.reason() + "\n";
    }
    return text;
}

std::string nearest_note(std::uint32_t asked, const v1::Representation& made) {
    const std::uint32_t faces = made.faces();
    if (asked == faces || asked == std::uint64_t{faces} + 1) return {};
    const bool inside = made.faces_min() <= asked && asked <= made.faces_max();
    const std::string which = inside ? " is the nearest resolution found that keeps the bounds" : " is the nearest resolution";
    return "vsplit: note: " + grouped(asked) + " faces asked for, " + grouped(faces) + which + " (there are " +
           grouped(made.faces_min()) + " to " + grouped(made.faces_max()) + ")\n";
}

std::string finding_messages(const v1::Representation& made) {
    std::string text;
    for (const v1::Finding& finding : made.source_findings())
        text += "vsplit: finding: " + finding.kind() + ": " + printable(finding.message()) + "\n";
    return text;
}

std::string assumed_unit_note(const std::string& path, const std::string& other, LengthUnit unit) {
    return "vsplit: note: the unit of " + path + " is not known; taken is " + std::string(unit_symbol(unit)) + ", that of " +
           other + "\n";
}

std::string nothing_removed_note(const FeatureRemoval& removal, const v1::ListFeaturesResponse& features) {
    if (!removal.max_diameter) return {};
    std::uint32_t larger = 0;
    double least = 0;
    for (const v1::ShapeFeature& feature : features.features()) {
        const bool asked = removal.kinds.empty() || std::any_of(removal.kinds.begin(), removal.kinds.end(), [&](auto kind) {
                               return wire::to_proto(kind) == feature.kind();
                           });
        if (!asked || feature.diameter() <= *removal.max_diameter) continue;
        least = larger++ == 0 ? feature.diameter() : std::min(least, feature.diameter());
    }
    const std::string unit = unit_suffix(unit_of(features));
    const std::string kinds = removal.kinds.empty() ? "" : " of the kinds asked for";
    std::string text = "vsplit: note: nothing is removed: no feature" + kinds + " has a diameter of " +
                       figure(*removal.max_diameter) + unit + " or less; ";
    text += larger == 0 ? "there are no larger ones either" : grouped(larger) + " larger: from " + figure(least) + unit + " on";
    return text + "\n";
}

std::string on_chord_note(std::uint32_t edges) {
    if (edges == 0) return "";
    return "vsplit: " + std::to_string(edges) + (edges == 1 ? " side stays" : " sides stay") +
           " straight: curved to the surface they would make bad elements of order 2\n";
}

std::string losses_note(const TriangleMesh& mesh, MeshFormat format, const std::string& path) {
    constexpr std::size_t kShown = 10;
    std::string text;
    const std::string begin = "vsplit: note: " + printable(path) + ": " + std::string(format_name(format));
    if (const std::vector<std::string> sets = sets_left_out(mesh, format); !sets.empty()) {
        text += begin + " has no room for " + counted(sets.size(), "set", "sets") + ": ";
        for (std::size_t i = 0; i < std::min(sets.size(), kShown); ++i)
            text.append(i == 0 ? "" : ", ").append(printable(sets[i]));
        text += sets.size() > kShown ? ", ...\n" : "\n";
    }
    if (const Rounding rounding = rounding_of(mesh, format); rounding.is_coarse()) {
        text += begin + " rounds coordinates to " + figure(rounding.step) + ", and the shortest edge is " +
                figure(rounding.shortest_edge) +
                ": faces change shape; other formats keep them, or move the mesh to the origin\n";
    }
    return text;
}

std::string controlled_surface_note(const v1::Representation& made) {
    if (made.method() != v1::CONTROL) return "";
    return "vsplit: note: the middle nodes lie on the mesh that control was given, of which the .vsplit file knows no more; "
           "write them by `vsplit control` itself to have them on the surface that a mesh of `improve` was made of\n";
}

std::string sent_surface_note(const std::string& input) {
    if (!is_representation_file(input)) return "";
    return "vsplit: note: the middle nodes lie on the mesh that was sent, one resolution of the .vsplit file; without a server "
           "they lie on its finest\n";
}

}  // namespace vsplit::cli

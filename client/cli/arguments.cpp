#include "cli/arguments.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <functional>
#include <iostream>
#include <map>
#include <optional>
#include <string_view>
#include <type_traits>

#include "cli/app.h"
#include "cli/message.h"
#include "wire/convert.h"
#include "wire/enum_value.h"

namespace vsplit::cli {
namespace {

constexpr const char* kAbout =
    "vsplit makes triangle meshes fit for finite-element analysis, at any resolution.\n"
    "All lengths are in the unit of the mesh, which --unit states. `vsplit VERB --help` tells a verb's options.";

constexpr const char* kExitStatuses =
    "Exit status: 0 done; 1 not done, stderr says why; 2 done, but a bound of control could not be met.\n"
    "Example:\n  vsplit improve crankshaft.stl -o improved.vsplit -o improved.stl";

constexpr const char* kSizingGroup = "Sizes that vary over the surface";

/// Refuses what is no number, in the words of the engine, before CLI11 does in its own.
template <class Number>
CLI::Validator accepts(const char* accepted) {
    const auto check = [accepted](const std::string& text) {
        Number value{};
        return CLI::detail::lexical_cast(text, value) ? std::string() : "'" + text + "' is given; accepted is " + accepted;
    };
    return {check, ""};
}

CLI::Validator whole_number() { return accepts<std::uint32_t>("a whole number from 0 to 4294967295"); }
CLI::Validator real_number() { return accepts<double>("a number, e.g. 0.25 or 1e-3"); }

CLI::Option* add_real(CLI::App& verb, const std::string& name, std::optional<double>& value, const std::string& about) {
    return verb.add_option(name, value, about)->check(real_number());
}

template <class Value>
CLI::Validator one_of(const std::map<std::string, Value>& values) {
    std::string accepted;
    for (const auto& [text, value] : values) accepted += (accepted.empty() ? "" : ", ") + text;
    const auto check = [values, accepted](const std::string& text) {
        return values.count(wire::folded(text)) > 0 ? std::string() : "'" + text + "' is given; accepted is one of " + accepted;
    };
    return {check, ""};
}

/// An option whose values have names.
template <class Value>
CLI::Option* add_choice(CLI::App& verb, const std::string& name, const std::map<std::string, Value>& values,
                        const std::function<void(Value)>& take, const std::string& about) {
    const auto convert = [values, take](const std::string& text) { take(values.at(wire::folded(text))); };
    return verb.add_option_function<std::string>(name, convert, about)->check(one_of(values));
}

void add_unit(CLI::App& verb, const std::string& name, std::optional<LengthUnit>& unit, const std::string& about) {
    std::map<std::string, LengthUnit> units;
    for (const LengthUnit known : length_units()) {
        units.emplace(unit_symbol(known), known);
        units.emplace(wire::folded(v1::LengthUnit_Name(wire::to_proto(known))), known);
    }
    add_choice<LengthUnit>(
        verb, name, units, [&unit](LengthUnit chosen) { unit = chosen; }, about)
        ->type_name("U");
}

void add_input(CLI::App& verb, Arguments& a, const char* what) {
    verb.add_option("IN", a.input, what);
    verb.add_option("--weld", a.weld,
                    "Merge vertices within this distance while reading a mesh; length, >= 0. Default 0: equal ones only")
        ->check(real_number())
        ->type_name("T");
    add_choice<v1::Repair>(
        verb, "--repair", {{"none", v1::NONE}, {"safe", v1::SAFE}, {"full", v1::FULL}},
        [&a](v1::Repair repair) { a.repair = repair; },
        "Mend a broken mesh: none says what stands in the way; safe cuts apart and turns faces; full stitches cracks and fills "
        "small holes too. Default: nothing is mended")
        ->type_name("R");
    add_real(verb, "--stitch", a.stitch,
             "With --repair full, borders this close are joined; length, >= 0. Default: 0.2 % of the diagonal of the mesh's box")
        ->type_name("L");
    add_real(verb, "--hole-size", a.hole_size,
             "With --repair full, holes with a box of at most this diagonal are filled; length, >= 0. Default: 5 %")
        ->type_name("L");
    add_real(verb, "--speck-size", a.speck_size,
             "With --repair full, pieces with a box of a smaller diagonal are dropped, the largest aside; length, >= 0. Default: "
             "0.1 %")
        ->type_name("L");
    add_unit(verb, "--unit", a.unit,
             "Unit of the lengths in IN, where it does not say it: um, mm, cm, m, in or ft. 3MF says it; default: not known");
}

/// "quantised" alone is the usual number of bits.
std::optional<EncodingChoice> encoding_in(const std::string& text) {
    const std::size_t colon = text.find(':');
    const std::string name = wire::folded(text.substr(0, colon));
    EncodingChoice choice;
    if (name == "float32") choice.encoding = RecordEncoding::kFloat32;
    if (name == "quantised") choice.encoding = RecordEncoding::kQuantised;
    if (name != "float64" && choice.encoding == RecordEncoding::kFloat64) return {};
    if (colon != std::string::npos && (!CLI::detail::lexical_cast(text.substr(colon + 1), choice.bits) || choice.bits == 0))
        return {};
    const Expected<EncodingChoice> checked = check_encoding(choice);
    if (!checked) return {};
    return *checked;
}

void add_output(CLI::App& verb, Arguments& a) {
    verb.add_option(
            "-o,--output", a.outputs,
            "File to write, its format by extension: .stl .obj .ply .off .msh .inp .bdf .vtk .vtu .3mf .vsplit; may be repeated")
        ->type_name("OUT")
        ->expected(1)
        ->take_all()
        ->allow_extra_args(false);
    verb.add_option("--format", a.format,
                    "Format of OUT instead: stl, stl-ascii, obj, ply, ply-ascii, off, msh, msh-ascii, msh2, msh2-ascii, inp, "
                    "bdf, vtk, vtk-ascii, "
                    "vtu, 3mf or vsplit")
        ->type_name("F");
    verb.add_option("--order", a.order,
                    "Of the elements in OUT: 1, or 2 for triangles of six nodes, the middle ones on the surface worked on, of a "
                    ".vsplit file IN on its finest resolution (msh, inp, bdf, vtk, vtu). Default 1")
        ->check(CLI::Range(1U, 2U).description(""))
        ->type_name("N");
    verb.add_option_function<std::string>(
            "--encoding", [&a](const std::string& text) { a.encoding = encoding_in(text); },
            "Of positions in .vsplit files OUT: float64, exact; float32; or quantised:N, rounded to a grid of N bits, 10 to 24, "
            "over "
            "the mesh. Default: as IN where that is one, else float64")
        ->check(CLI::Validator(
            [](const std::string& text) {
                return encoding_in(text)
                           ? std::string()
                           : "'" + text + "' is given; accepted are float64, float32 and quantised:10 to quantised:24";
            },
            ""))
        ->type_name("E");
    add_unit(verb, "--output-unit", a.output_unit,
             "Convert the lengths in mesh files OUT to this unit; that of IN must be known. Default: as IN");
    verb.add_flag("--json", a.json, "Print one JSON document on the standard output");
    verb.add_flag("--no-progress", a.no_progress, "No progress bar; there is none anyway where stderr is no terminal");
    verb.add_option("--threads", a.threads, "Threads to use, 0 to 1024; the result does not depend on it. Default 0: all cores")
        ->check(whole_number())
        ->check(CLI::Range(0U, 1024U).description(""))
        ->type_name("N");
}

void add_server(CLI::App& verb, Arguments& a) {
    constexpr const char* kGroup = "With a server";
    verb.add_option("--server", a.server, "Work on this vsplitd instead of in this process")
        ->check(CLI::Validator(
            [](const std::string& text) { return text.empty() ? std::string("is empty; accepted is HOST:PORT") : ""; }, ""))
        ->type_name("HOST:PORT")
        ->group(kGroup);
    verb.add_option("--tls-ca", a.tls_ca, "Speak TLS; authorities (PEM) that sign for the server, or system for the machine's")
        ->type_name("FILE")
        ->group(kGroup);
    verb.add_option("--tls-cert", a.tls_cert, "Certificate (PEM) to show to a server that wants one")
        ->type_name("FILE")
        ->group(kGroup);
    verb.add_option("--tls-key", a.tls_key, "Its private key (PEM)")->type_name("FILE")->group(kGroup);
    verb.add_option("--token-file", a.token_file, "The token for the server. Default: the variable VSPLIT_TOKEN")
        ->type_name("FILE")
        ->group(kGroup);
    verb.add_option("--session", a.session, "Use this session instead of uploading; leave IN out, or give -")
        ->type_name("ID")
        ->group(kGroup);
    verb.add_option("--representation", a.representation,
                    "The representation of the session to start from. Default: the upload "
                    "(resolution: the newest)")
        ->type_name("ID")
        ->group(kGroup);
    verb.add_flag("--keep", a.keep, "Keep the new session, and print 'session ID' on stderr")->group(kGroup);
}

void add_resolution(CLI::App& verb, Arguments& a, const char* what) {
    verb.add_option("--faces", a.faces, what)->check(whole_number())->type_name("N");
}

SizingOptions& sizing_in(std::optional<SizingOptions>& sizing) { return sizing ? *sizing : sizing.emplace(); }

/// The numbers of a list like 1,2,3.5; empty unless they are as many as asked for.
std::vector<double> numbers_in(const std::string& text, std::size_t count) {
    std::vector<double> numbers;
    for (const std::string& word : CLI::detail::split(text, ',')) {
        double number{};
        if (!CLI::detail::lexical_cast(word, number)) return {};
        numbers.push_back(number);
    }
    return numbers.size() == count ? numbers : std::vector<double>();
}

/// An option that is a list of `count` numbers and may be repeated.
void add_shape(CLI::App& verb, const std::string& name, const char* form, std::size_t count,
               const std::function<void(const std::vector<double>&)>& take, const std::string& about) {
    const auto check = [form, count](const std::string& text) {
        return numbers_in(text, count).empty()
                   ? "'" + text + "' is given; accepted is " + form + ", " + std::to_string(count) + " numbers without blanks"
                   : std::string();
    };
    const auto convert = [take, count](const std::vector<std::string>& texts) {
        for (const std::string& text : texts) take(numbers_in(text, count));
    };
    verb.add_option_function<std::vector<std::string>>(name, convert, about)
        ->check(CLI::Validator(check, ""))
        ->type_name(form)
        ->expected(1)
        ->take_all()
        ->allow_extra_args(false)
        ->group(kSizingGroup);
}

void add_size(CLI::App& verb, const std::string& name, const std::string& about, const std::function<void(double)>& take) {
    verb.add_option_function<double>(name, take, about)->check(real_number())->type_name("S")->group(kSizingGroup);
}

template <class Options>
void add_sizing(CLI::App& verb, Arguments& a, Options& o) {
    add_shape(
        verb, "--size-sphere", "X,Y,Z,RADIUS,SIZE", 5,
        [&o](const std::vector<double>& n) {
            sizing_in(o.sizing).spheres.push_back({{n[0], n[1], n[2]}, n[3], n[4]});
        },
        "No edge in this ball is longer than SIZE; may be repeated");
    add_shape(
        verb, "--size-box", "X0,Y0,Z0,X1,Y1,Z1,SIZE", 7,
        [&o](const std::vector<double>& n) {
            sizing_in(o.sizing).boxes.push_back({{n[0], n[1], n[2]}, {n[3], n[4], n[5]}, n[6]});
        },
        "No edge in this box is longer than SIZE; may be repeated");
    add_size(verb, "--chord-error",
             "Edges whose chord lies this close to a circle of the curvature; deviation is bounded by --max-deviation. > 0. "
             "Default: none",
             [&o](double value) { sizing_in(o.sizing).chord_error = value; });
    add_size(verb, "--gradation", "Most that the size grows by per unit of length; more than 0, at most 1. Default 0.3",
             [&o](double value) { sizing_in(o.sizing).gradation = value; });
    if constexpr (std::is_same_v<Options, ImproveOptions>) {  // control has it as a bound of its own
        add_size(verb, "--min-size", "No size is less than this, whatever asks for it; length > 0. Default: no bound",
                 [&o](double value) { sizing_in(o.sizing).min_size = value; });
    }
    verb.add_option("--size-field", a.size_field,
                    "Text file of sizes, a number a line, one for each vertex of IN in order, 0 for no bound")
        ->type_name("FILE")
        ->group(kSizingGroup);
}

/// What improve and control share.
template <class Options>
void add_method(CLI::App& verb, Arguments& a, Options& o, const char* default_faces) {
    verb.add_option("--faces", o.faces, std::string("Faces of the result; >= 4. Default: ") + default_faces)
        ->check(whole_number())
        ->type_name("N");
    verb.add_option(
            "--faces-min", o.faces_min,
            "Simplify on to this many faces, for coarser resolutions in a .vsplit file; 4 to --faces. Default 4: as far as "
            "it goes")
        ->check(whole_number())
        ->type_name("N");
    verb.add_option(
            "--tolerance", o.tolerance,
            "Bound of a collapse's quadric error, as a length > 0: the square root of the paper's tau_TL. Default half of "
            "--max-deviation, or 0.1 % of the bounding box's diagonal")
        ->check(real_number())
        ->type_name("T");
    verb.add_option("--max-deviation", o.max_deviation,
                    "Length > 0: no point of the result is further from the source, nor of the source from the result; mode "
                    "extended only. "
                    "Certain where given, if need be with more faces. Default twice --tolerance; where two attempts do not keep "
                    "that, the options used say what was measured")
        ->check(real_number())
        ->type_name("D");
    verb.add_option("--feature-angle", o.feature_angle,
                    "An edge whose faces' normals differ by more is kept as a crease; degrees, 0 to 180. Default 40")
        ->check(real_number())
        ->type_name("A");
    verb.add_option("--feature-weight", o.feature_weight,
                    "Weight of a right-angled crease against the planes, 0 to 1e6. Default 10")
        ->check(real_number())
        ->type_name("W");
    add_choice<FeatureDetection>(
        verb, "--feature-detection",
        {{"dihedral", FeatureDetection::kDihedral}, {"normal-voting", FeatureDetection::kNormalVoting}},
        [&o](FeatureDetection detection) { o.feature_detection = detection; },
        "dihedral|normal-voting: creases by the angle at an edge, or by the normals around it, for noisy scans. Default dihedral")
        ->type_name("D");
    verb.add_flag_callback(
        "--freeze-boundary", [&o] { o.freeze_boundary = true; },
        "Keep open boundaries exactly, vertices and edges, at every resolution. Without it they are kept within the tolerance");
    add_choice<Mode>(
        verb, "--mode", {{"strict", Mode::kStrict}, {"extended", Mode::kExtended}}, [&o](Mode mode) { o.mode = mode; },
        "strict|extended: strict is the paper's method alone; extended adds flips and moves, keeps creases apart and bounds the "
        "deviation. Default extended")
        ->type_name("M");
    verb.add_option(
            "--source-faces", a.source_faces,
            "Where IN is a .vsplit file or --representation is given: its resolution to start from. Default: the one it was "
            "made for")
        ->check(whole_number())
        ->type_name("N");
    add_sizing(verb, a, o);
}

void add_info(CLI::App& app, Arguments& a) {
    CLI::App& verb = *app.add_subcommand("info", "Counts, topology and shape of a mesh, or what a .vsplit file holds");
    add_input(verb, a, "Mesh (STL, OBJ, PLY, OFF, MSH, INP, BDF, VTK, VTU, 3MF; told from its bytes) or .vsplit file");
    add_resolution(verb, a, "Resolution of a representation to describe. Default: the one it was made for");
    verb.footer("Example:\n  vsplit info part.stl --json");
}

void add_quality(CLI::App& app, Arguments& a) {
    CLI::App& verb = *app.add_subcommand("quality", "As info, with the histogram of stretch and the worst faces");
    add_input(verb, a, "Mesh (STL, OBJ, PLY, OFF, MSH, INP, BDF, VTK, VTU, 3MF; told from its bytes) or .vsplit file");
    verb.add_option("--against", a.against,
                    "Measure the distance to this mesh or .vsplit file instead, both ways and between creases; not with a server")
        ->type_name("FILE");
    add_choice<v1::QualityProfile>(
        verb, "--profile", {{"stretch-02", v1::STRETCH_02}, {"verdict", v1::VERDICT}, {"optistruct", v1::OPTISTRUCT}},
        [&a](v1::QualityProfile profile) { a.profile = profile; },
        "stretch-02|verdict|optistruct: count the faces that pass, are warned of and fail by these limits. Default: none")
        ->type_name("P");
    verb.add_option("--error", a.error,
                    "With --against: how close the bounds of the distances are to be; length > 0. Default 2 % of them or 1e-5 of "
                    "the diagonal, whichever is more")
        ->check(real_number())
        ->type_name("E");
    add_resolution(verb, a, "Resolution of a representation to describe. Default: the one it was made for");
    verb.footer(
        "Stretch is sqrt(12) * inradius / longest edge: 1 equilateral, 0 degenerate; solvers want 0.2 and more.\n"
        "Example:\n  vsplit quality improved.vsplit --faces 5000\n  vsplit quality improved.stl --against part.stl");
}

void add_improve(CLI::App& app, Arguments& a) {
    CLI::App& verb = *app.add_subcommand("improve", "Improve the shape of the faces within a tolerance of the surface");
    add_input(verb, a,
              "Mesh, closed or with open boundaries (STL, OBJ, PLY, OFF, MSH, INP, BDF, VTK, VTU, 3MF; told from its bytes) or "
              ".vsplit file");
    verb.add_option("--subdivide", a.improve.subdivision_size,
                    "Split edges until none is longer (the paper's sigma_SZ); length > 0. Default the mean edge of --faces, or "
                    "1.5 % of the "
                    "bounding box's diagonal (strict: 1 %), or more so that at most a million faces come out")
        ->check(real_number())
        ->type_name("S");
    add_real(verb, "--min-stretch", a.improve.min_stretch,
             "Leave no face of less stretch where none was; 0 to 1. Default 0.4 (strict: 0)")
        ->type_name("X");
    add_real(
        verb, "--min-mean-stretch", a.improve.min_mean_stretch,
        "Stop where the mean stretch gets less, but not before --faces; 0 to 1. Default 0.8 (strict, and with --faces-min: 0)")
        ->type_name("X");
    add_method(verb, a, a.improve,
               "what sizes and --subdivide ask for, but no fewer than --min-mean-stretch takes (strict: a mean edge of 1.5 times "
               "--subdivide, but at least twice as many as the coarsest resolution has)");
    verb.footer("Example:\n  vsplit improve crankshaft.stl --subdivide 8 --tolerance 1 --faces 30000 -o improved.vsplit");
}

void add_control(CLI::App& app, Arguments& a) {
    CLI::App& verb =
        *app.add_subcommand("control", "Bring stretch, size and valence within bounds; for meshes that were improved");
    add_input(verb, a,
              "Mesh, closed or with open boundaries (STL, OBJ, PLY, OFF, MSH, INP, BDF, VTK, VTU, 3MF; told from its bytes) or "
              ".vsplit file");
    verb.add_option("--subdivisions", a.control.subdivisions, "One-to-four subdivisions first; 0 to 12. Default 1")
        ->check(whole_number())
        ->type_name("n");
    verb.add_option("--min-stretch", a.control.min_stretch, "Least stretch of a face (tau_ST); 0 to 1. Default 0.2")
        ->check(real_number())
        ->type_name("X");
    verb.add_option("--max-size", a.control.max_size, "Longest edge (tau_SZ); length > 0. Default: no bound")
        ->check(real_number())
        ->type_name("S");
    verb.add_option("--max-valence", a.control.max_valence, "Most edges at a vertex (tau_VL); >= 6. Default: no bound")
        ->check(whole_number())
        ->type_name("V");
    add_real(verb, "--min-angle", a.control.min_angle, "Least angle of a face; degrees, > 0, < 60. Default: no bound")
        ->type_name("A");
    add_real(verb, "--max-angle", a.control.max_angle, "Largest angle of a face; degrees, > 60, < 180. Default: no bound")
        ->type_name("A");
    add_real(verb, "--max-aspect-ratio", a.control.max_aspect_ratio,
             "Longest edge of a face over its shortest; >= 1. Default: no bound")
        ->type_name("R");
    add_real(verb, "--min-size", a.control.min_size,
             "Least length of a face's longest edge, and of what --size-sphere and the like ask for; > 0. Default: no bound")
        ->type_name("S");
    add_method(verb, a, a.control, "as many as IN has, or near that where the bounds hold");
    verb.footer(
        "Where a bound is broken at the faces asked for, and all hold within 10 % of them, that resolution is taken.\n"
        "Exit status 2 says that a bound could not be met; stderr says which, how often, where and why; --json lists up to\n"
        "10,000 faces (vertices for --max-valence).\n"
        "Example:\n  vsplit control improved.vsplit --min-stretch 0.2 --max-valence 10 --max-size 12 -o controlled.stl");
}

void add_resolution_verb(CLI::App& app, Arguments& a) {
    CLI::App& verb = *app.add_subcommand("resolution", "The mesh of a representation at another resolution");
    add_input(verb, a, ".vsplit file");
    add_resolution(verb, a, "Resolution; the nearest that exists is taken. Default: the one it was made for");
    verb.footer("Example:\n  vsplit resolution improved.vsplit --faces 5000 -o coarse.stl");
}

/// What features and remove-features share.
void add_feature_search(CLI::App& verb, Arguments& a) {
    add_input(verb, a,
              "Closed mesh (STL, OBJ, PLY, OFF, MSH, INP, BDF, VTK, VTU, 3MF; told from its bytes) or .vsplit file at the "
              "resolution it "
              "was made for");
    verb.add_option("--angle", a.removal.search.angle,
                    "Edges that bend by more part the surface; degrees, > 0, < 180. Default 40: holes of fewer than 9 sides are "
                    "not found")
        ->check(real_number())
        ->type_name("A");
}

/// The kinds of features that the diameter holds for; may be repeated.
void add_kinds(CLI::App& verb, Arguments& a) {
    using Kind = ShapeFeature::Kind;
    const std::map<std::string, Kind> kinds{
        {"through-hole", Kind::kThroughHole}, {"blind-hole", Kind::kBlindHole}, {"boss", Kind::kBoss}, {"fillet", Kind::kFillet}};
    const auto take = [kinds, &a](const std::vector<std::string>& names) {
        for (const std::string& name : names) a.removal.kinds.push_back(kinds.at(wire::folded(name)));
    };
    verb.add_option_function<std::vector<std::string>>(
            "--kind", take,
            "With --max-diameter: remove through-hole, blind-hole, boss or fillet alone; may be repeated. Default: all")
        ->check(one_of(kinds))
        ->type_name("K")
        ->expected(1)
        ->take_all()
        ->allow_extra_args(false);
}

void add_features(CLI::App& app, Arguments& a) {
    CLI::App& verb = *app.add_subcommand("features", "List round holes, bosses and fillets with diameter, depth and axis");
    add_feature_search(verb, a);
    verb.footer("Example:\n  vsplit features crankshaft.stl");
}

void add_remove_features(CLI::App& app, Arguments& a) {
    CLI::App& verb =
        *app.add_subcommand("remove-features", "Fill round holes, take bosses away, chamfer fillets; the rest stays as it is");
    add_feature_search(verb, a);
    verb.add_option("--id", a.removal.ids, "Feature to remove, by the number that `vsplit features` gives it; may be repeated")
        ->check(whole_number())
        ->type_name("N")
        ->expected(1)
        ->take_all()
        ->allow_extra_args(false);
    add_real(verb, "--max-diameter", a.removal.max_diameter, "Remove all of this diameter (to 0.01 %) and less; length > 0")
        ->type_name("D");
    add_kinds(verb, a);
    verb.footer(
        "With --session the result takes the place of the session's mesh.\n"
        "Example:\n  vsplit remove-features plate.stl --max-diameter 6 -o filled.stl");
}

const std::map<std::string_view, Verb>& verbs() {
    static const std::map<std::string_view, Verb> all{{"info", Verb::kInfo},
                                                      {"improve", Verb::kImprove},
                                                      {"control", Verb::kControl},
                                                      {"resolution", Verb::kResolution},
                                                      {"quality", Verb::kQuality},
                                                      {"features", Verb::kFeatures},
                                                      {"remove-features", Verb::kRemoveFeatures}};
    return all;
}

std::string verb_names() {
    std::string names;
    for (const auto& [name, verb] : verbs()) names += (names.empty() ? "" : ", ") + std::string(name);
    return names;
}

int refuse(const CLI::App& app, const CLI::ParseError& error) {
    const std::vector<CLI::App*> chosen = app.get_subcommands();
    const std::string help = chosen.empty() ? "vsplit --help" : "vsplit " + chosen.front()->get_name() + " --help";
    const bool unknown = chosen.empty() && !app.remaining().empty();
    const std::string verb = unknown ? "there is no verb '" + app.remaining().front() + "'" : "no verb is given";
    const std::string what = chosen.empty() ? verb + "; accepted is one of " + verb_names() : error.what();
    std::cerr << error_message({Cause::kInvalidOption, what + "; see `" + help + "`", ""});
    return kExitFailed;
}

void build(CLI::App& app, Arguments& a) {
    app.set_version_flag("--version", "vsplit " VSPLIT_VERSION);
    app.footer(kExitStatuses);
    app.require_subcommand(1);
    add_info(app, a);
    add_improve(app, a);
    add_control(app, a);
    add_resolution_verb(app, a);
    add_quality(app, a);
    add_features(app, a);
    add_remove_features(app, a);
    for (CLI::App* verb : app.get_subcommands({})) {
        add_output(*verb, a);
        add_server(*verb, a);
    }
}

}  // namespace

std::variant<Arguments, int> parse(int argc, const char* const* argv) {
    Arguments arguments;
    CLI::App app(kAbout, "vsplit");
    build(app, arguments);
    try {
        app.parse(argc, argv);
    } catch (const CLI::Success& e) {  // --help, --version
        return app.exit(e);
    } catch (const CLI::ParseError& e) {
        return refuse(app, e);
    }
    arguments.verb = verbs().at(app.get_subcommands().front()->get_name());
    ControlOptions& control = arguments.control;
    if (control.min_size && (control.sizing || !arguments.size_field.empty()))
        sizing_in(control.sizing).min_size = control.min_size;
    return arguments;
}

std::optional<std::uint32_t> asked_faces(const Arguments& arguments) {
    if (arguments.verb == Verb::kImprove) return arguments.improve.faces;
    if (arguments.verb == Verb::kControl) return arguments.control.faces;
    return arguments.faces;
}

bool is_representation_file(const std::string& name) {
    constexpr std::string_view kExtension = ".vsplit";
    const auto same = [](char left, char right) { return left == std::tolower(static_cast<unsigned char>(right)); };
    return name.size() > kExtension.size() &&
           std::equal(kExtension.begin(), kExtension.end(), name.end() - static_cast<std::ptrdiff_t>(kExtension.size()), same);
}

}  // namespace vsplit::cli

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "vsplit/mesh/length_unit.h"
#include "vsplit/method/method_options.h"
#include "vsplit/mrr/position_grid.h"
#include "vsplit/shapes/remove_features.h"
#include "vsplit/v1/meshing.pb.h"

namespace vsplit::cli {

enum class Verb { kInfo, kImprove, kControl, kResolution, kQuality, kFeatures, kRemoveFeatures };

/// The command line, as it was given; nothing is checked here but its grammar.
struct Arguments {
    Verb verb = Verb::kInfo;
    std::string input;  ///< file; empty or "-" with a session
    std::vector<std::string> outputs;
    std::string format;                      ///< of the outputs; empty: by extension
    std::uint32_t order = 1;                 ///< of the outputs' elements
    std::optional<EncodingChoice> encoding;  ///< of .vsplit outputs; empty: as IN, or exact
    bool json = false;
    bool no_progress = false;
    unsigned threads = 0;  ///< 0: all cores
    double weld = 0;
    v1::Repair repair = v1::REPAIR_UNSPECIFIED;
    std::optional<double> stitch;  ///< these three with a full repair alone
    std::optional<double> hole_size;
    std::optional<double> speck_size;
    std::optional<LengthUnit> unit;             ///< of IN, where it does not say it
    std::optional<LengthUnit> output_unit;      ///< of the outputs; empty: as IN
    std::optional<std::uint32_t> faces;         ///< info, quality, resolution: the resolution to show
    std::optional<std::uint32_t> source_faces;  ///< improve, control: resolution of the representation to work on
    std::string size_field;                     ///< improve, control: file of sizes, read by read_size_field_into
    ImproveOptions improve;
    ControlOptions control;
    std::string against;          ///< quality: the mesh to measure the distance to; empty: none
    std::optional<double> error;  ///< quality against: most error of the distances; empty: the default
    v1::QualityProfile profile = v1::QUALITY_PROFILE_UNSPECIFIED;  ///< quality: whose limits to check
    FeatureRemoval removal;  ///< features, remove-features: how they are found, and which go
    std::string server;
    std::string tls_ca;      ///< file, or "system"
    std::string tls_cert;    ///< file
    std::string tls_key;     ///< file
    std::string token_file;  ///< empty: the environment has the token
    std::string session;
    std::string representation;
    bool keep = false;
};

/// Parses; prints help, version, or what is wrong with the line, and then returns the exit status instead.
[[nodiscard]] std::variant<Arguments, int> parse(int argc, const char* const* argv);

/// The resolution that --faces asks for, whichever verb it was given to.
[[nodiscard]] std::optional<std::uint32_t> asked_faces(const Arguments& arguments);

/// Whether a file's name is that of a stored representation.
[[nodiscard]] bool is_representation_file(const std::string& name);

}  // namespace vsplit::cli

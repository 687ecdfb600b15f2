#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "vsplit/mesh/length_unit.h"
#include "vsplit/method/method_options.h"
#include "vsplit/mrr/multires_mesh.h"
#include "vsplit/quality/mesh_quality.h"
#include "vsplit/quality/slivers.h"

namespace vsplit {

/// A bound of control that the mesh at the asked resolution breaks.
struct Violation {
    static constexpr std::size_t kMostElements = 10'000;

    std::string bound;                    ///< the field of the options, as "min_stretch" or "max_valence"
    double limit = 0;                     ///< what was asked
    double worst = 0;                     ///< what the worst face or vertex has, in the unit of the option
    std::uint32_t count = 0;              ///< faces (vertices for max_valence; 1 for max_deviation) that break it
    std::vector<std::uint32_t> elements;  ///< those faces or vertices, ascending, but at most kMostElements
    std::string reason;                   ///< one sentence: why it could not be mended
};

/// What a method tells of its result.
struct MethodFigures {
    MethodOptions options;  ///< as used, defaults filled in
    /// Resolution shown: the nearest to the one asked for that exists; near that one in control, and finer where max_deviation
    /// is given, where bounds hold there and not at the nearest.
    std::uint32_t faces = 0;
    std::uint32_t faces_subdivided = 0;  ///< faces before simplification; equals mrr.faces_max()
    Quality quality;                     ///< at `faces`
    std::vector<Violation> violations;   ///< at `faces`; empty when all bounds hold
    std::vector<Slivers> slivers;        ///< at `faces`: why there are faces under 0.2, by cause; empty where there are none
    std::chrono::duration<double> elapsed{};
    std::optional<LengthUnit> unit{};  ///< of all lengths here; the methods leave it to who knows the mesh's

    [[nodiscard]] bool bounds_satisfied() const { return violations.empty(); }
};

/// What both methods return: the MRR and the figures of the resolution that was asked for.
struct MethodResult : MethodFigures {
    MultiresMesh mrr;
};

}  // namespace vsplit

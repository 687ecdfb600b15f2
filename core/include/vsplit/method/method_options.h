#pragma once

#include <cstdint>
#include <optional>
#include <variant>
#include <vector>

#include "vsplit/base/expected.h"
#include "vsplit/features/creases.h"
#include "vsplit/mesh/triangle_mesh.h"
#include "vsplit/sizing/sizing_options.h"
#include "vsplit/subdivide/subdivide.h"

namespace vsplit {

/// STRICT is the paper's method; EXTENDED goes beyond it (docs/method.md): flips and moves beside collapses, creases kept apart,
/// and a bound on the deviation.
enum class Mode { kStrict, kExtended };

/// Default of `tolerance`, as a share of the bounding box's diagonal.
inline constexpr double kDefaultToleranceShare = 1e-3;
inline constexpr double kDefaultFeatureAngle = 40;  ///< degrees
inline constexpr double kDefaultFeatureWeight = 10;
inline constexpr std::uint32_t kLeastFaces = 4;  ///< a tetrahedron: no closed mesh has fewer

/// What `improve` may be asked for. Everything is optional; `default_options` says what is taken instead.
/// All lengths are in model units.
struct ImproveOptions {
    std::optional<double> subdivision_size{};  ///< sigma_SZ: no edge longer after subdivision; > 0. Default: see docs/method.md
    std::optional<double> tolerance{};  ///< > 0; sqrt of the paper's tau_TL (tau_TL = 2 is tolerance 1.414). Default 0.1 % of the
                                        ///< diagonal, or half of max_deviation
    /// > 0: no point of the result is further from the source, nor of the source from the result; EXTENDED only. Where it is
    /// given it is kept at the price of more faces than asked for if need be. Default: twice the tolerance; where the result was
    /// measured to be further away twice, the options as used say how far.
    std::optional<double> max_deviation{};
    std::optional<double> feature_angle{};     ///< degrees, 0..180; default 40
    std::optional<double> feature_weight{};    ///< w_e at a right angle; >= 0; default 10
    std::optional<std::uint32_t> faces{};      ///< resolution of the result; default: docs/method.md
    std::optional<std::uint32_t> faces_min{};  ///< simplify down to this many faces, or until no edge is valid; default 4
    std::optional<Mode> mode{};                ///< default EXTENDED
    std::optional<FeatureDetection> feature_detection{};  ///< how creases are found; default DIHEDRAL
    std::vector<std::uint32_t> marked_edges{};  ///< edges to keep as creases, as pairs of vertices of the source; default none
    std::vector<std::uint32_t> regions{};       ///< an id a face of the source; borders between ids are creases. Default none
    std::optional<SizingOptions> sizing{};  ///< edges no longer than a place on the surface allows. Default: no bound, but see
                                            ///< docs/method.md for what sizes follow where `faces` is not given
    /// Every resolution has exactly the source's open boundaries, vertices and edges; no effect on a closed mesh. Default false
    std::optional<bool> freeze_boundary{};
    /// 0..1: no collapse leaves a face of less stretch where none was. Default EXTENDED 0.4, STRICT 0 (the paper has no floor)
    std::optional<double> min_stretch{};
    /// 0..1: simplification ends where the mean stretch gets less: there is the coarsest resolution, but `faces` come first where
    /// they are given. Default EXTENDED 0.8, or 0 where faces_min is given; STRICT 0
    std::optional<double> min_mean_stretch{};

    friend bool operator==(const ImproveOptions&, const ImproveOptions&) = default;
};

/// What `control` may be asked for. Lengths in model units.
struct ControlOptions {
    std::optional<std::uint32_t> subdivisions{};          ///< one-to-four, 0..12 times; default 1
    std::optional<double> tolerance{};                    ///< as in ImproveOptions
    std::optional<double> max_deviation{};                ///< as in ImproveOptions
    std::optional<double> min_stretch{};                  ///< tau_ST, 0..1; default 0.2
    std::optional<double> max_size{};                     ///< tau_SZ, > 0; default none
    std::optional<std::uint32_t> max_valence{};           ///< tau_VL, >= 6; default none
    std::optional<double> min_angle{};                    ///< degrees, > 0, < 60: least angle of a face; default none
    std::optional<double> max_angle{};                    ///< degrees, > 60, < 180: largest angle of a face; default none
    std::optional<double> max_aspect_ratio{};             ///< longest edge of a face over its shortest, >= 1; default none
    std::optional<double> min_size{};                     ///< > 0, at most max_size: least longest edge of a face; default none
    std::optional<double> feature_angle{};                ///< as in ImproveOptions
    std::optional<double> feature_weight{};               ///< as in ImproveOptions
    std::optional<std::uint32_t> faces{};                 ///< resolution of the result; default: as many as the source has
    std::optional<std::uint32_t> faces_min{};             ///< as in ImproveOptions
    std::optional<Mode> mode{};                           ///< default EXTENDED
    std::optional<FeatureDetection> feature_detection{};  ///< as in ImproveOptions
    std::vector<std::uint32_t> marked_edges{};            ///< as in ImproveOptions
    std::vector<std::uint32_t> regions{};                 ///< as in ImproveOptions
    std::optional<SizingOptions> sizing{};                ///< as in ImproveOptions; max_size bounds it too
    std::optional<bool> freeze_boundary{};                ///< as in ImproveOptions

    friend bool operator==(const ControlOptions&, const ControlOptions&) = default;
};

/// What either method is asked for; which one says which method it is.
using MethodOptions = std::variant<ImproveOptions, ControlOptions>;

/// Limits the host sets, not the user of a method.
struct MethodLimits {
    std::uint32_t max_faces = 20'000'000;  ///< after subdivision
    FaceLimit::Admit admit{};              ///< asked before every subdivision
};

/// Ranges and contradictions. \return INVALID_OPTION or UNSUPPORTED naming the field, what it was and what would be accepted.
/// O(size of the options).
[[nodiscard]] Status check_options(const ImproveOptions& options);
[[nodiscard]] Status check_options(const ControlOptions& options);

/// What only the source can tell: whether marked_edges, regions and sizing.field fit it, max_deviation is above what its
/// coordinates resolve, and its shape leaves room for min_size, max_valence and, with freeze_boundary, max_size. \pre `source` is
/// manifold, `options` were checked. \return INVALID_OPTION. O(faces).
[[nodiscard]] Status check_options_on(const TriangleMesh& source, const ImproveOptions& options);
[[nodiscard]] Status check_options_on(const TriangleMesh& source, const ControlOptions& options);

/// What is asked for about creases, defaults filled in.
[[nodiscard]] FeatureOptions feature_options(const ImproveOptions& options);
[[nodiscard]] FeatureOptions feature_options(const ControlOptions& options);

/// What is asked for about sizes, for `make_size_field`: `sizing`, and `max_size` of control as a bound everywhere. Empty when
/// neither is given.
[[nodiscard]] std::optional<SizingOptions> sizing_options(const ImproveOptions& options);
[[nodiscard]] std::optional<SizingOptions> sizing_options(const ControlOptions& options);

}  // namespace vsplit

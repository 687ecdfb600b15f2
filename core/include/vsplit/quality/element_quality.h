#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "vsplit/base/expected.h"
#include "vsplit/mesh/triangle_mesh.h"

namespace vsplit {

/// A triangle's shape in the figures that finite-element programs know. Angles in degrees. A triangle without area has infinite
/// ratios.
struct ElementQuality {
    double stretch = 0;       ///< [Date05] Eq. 6; 1 equilateral
    double min_angle = 0;     ///< 60 equilateral
    double max_angle = 0;     ///< 60 equilateral
    double edge_ratio = 0;    ///< longest over shortest edge; 1 equilateral
    double aspect_ratio = 0;  ///< Verdict's: longest edge over 2 sqrt(3) inradii; 1 equilateral
    double radius_ratio = 0;  ///< circumradius over 2 inradii; 1 equilateral
    double skew = 0;          ///< OptiStruct's: 90 less the smallest angle between a median and the line of the middles beside it
    double scaled_jacobian = 0;  ///< Verdict's: least sine of an angle times 2 / sqrt(3); 1 equilateral
};

/// O(1).
[[nodiscard]] ElementQuality element_quality(const Vec3& a, const Vec3& b, const Vec3& c);

/// Whose limits.
enum class QualityProfile {
    kStretch02,  ///< stretch: warning under 0.4, failure under 0.2 ([Date05] 3.3)
    kVerdict,  ///< failure outside the acceptable ranges of the Verdict manual (Stimpson et al. 2007) for triangles, as PyVista's
               ///< table of them has them too
    kOptistruct,  ///< warning and error limits of OptiStruct's element check for CTRIA3
};

/// "stretch-02", "verdict", "optistruct".
[[nodiscard]] std::string_view profile_name(QualityProfile profile);

/// The inverse. \return INVALID_OPTION listing the names.
[[nodiscard]] Expected<QualityProfile> profile_by_name(std::string_view name);

/// How a mesh does by one figure of a profile.
struct CriterionReport {
    std::string name;  ///< as in ElementQuality, e.g. "min_angle"
    double worst = 0;  ///< of all faces
    std::uint32_t worst_face = 0;
    std::uint32_t warned = 0;  ///< faces beyond the warning limit and within that of failure
    std::uint32_t failed = 0;
    bool upper = false;     ///< whether the limits are the most that is accepted; else the least
    double warn_limit = 0;  ///< beyond it a face is warned of; that of failure where a profile has no warnings
    double fail_limit = 0;  ///< beyond it a face fails
};

/// How a mesh does by a profile. A face fails where one of its figures does, else is warned of where one is.
struct ProfileReport {
    QualityProfile profile{};
    std::uint32_t passed = 0;
    std::uint32_t warned = 0;
    std::uint32_t failed = 0;
    std::vector<CriterionReport> criteria;
    std::vector<std::uint32_t> worst;  ///< faces that do not pass: failed ones first, then those of least stretch, ties by index
};

/// `worst` is how many faces to list at most. O(faces log worst).
[[nodiscard]] ProfileReport check_profile(const TriangleMesh& mesh, QualityProfile profile, std::size_t worst);

}  // namespace vsplit

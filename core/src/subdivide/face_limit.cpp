#include "subdivide/face_limit.h"

#include <cmath>
#include <string>

#include "base/number_text.h"

namespace vsplit {
namespace {

constexpr std::uint32_t kMaxTimes = 12;
constexpr double kRoundedUp = 1 + 1e-5;  // six digits are written, which must not be too few

Status check_as_it_is(const TriangleMesh& mesh, std::uint32_t face_limit, const char* field) {
    if (mesh.face_count() <= face_limit) return Done{};
    return Error{Cause::kLimitExceeded,
                 "the mesh has " + std::to_string(mesh.face_count()) + " faces; the limit is " + std::to_string(face_limit),
                 field};
}

}  // namespace

Status check_subdivision(const TriangleMesh& mesh, double max_edge, std::uint32_t face_limit) {
    if (!(max_edge > 0) || !std::isfinite(max_edge)) {
        return Error{Cause::kInvalidOption, "the subdivision size is " + number_text(max_edge) + "; a positive length is needed",
                     "subdivision_size"};
    }
    return check_as_it_is(mesh, face_limit, "subdivision_size");
}

Status check_subdivision_to_sizes(const TriangleMesh& mesh, std::uint32_t face_limit) {
    return check_as_it_is(mesh, face_limit, "sizing");
}

Error too_many_faces(double max_edge, std::uint32_t face_limit, double fitting) {
    return {Cause::kLimitExceeded,
            "subdividing to edges of " + number_text(max_edge) + " makes more than " + std::to_string(face_limit) +
                " faces, the limit; a subdivision size of " + number_text(kRoundedUp * fitting) + " fits",
            "subdivision_size"};
}

Error too_many_faces_of_sizes(std::uint32_t face_limit, double fitting) {
    return {Cause::kLimitExceeded,
            "subdividing to these sizes makes more than " + std::to_string(face_limit) +
                " faces, the limit; with no size under " + number_text(kRoundedUp * fitting) + " (min_size) it fits",
            "sizing"};
}

Status check_times(const TriangleMesh& mesh, std::uint32_t times, std::uint32_t face_limit) {
    if (times > kMaxTimes) {
        return Error{Cause::kInvalidOption,
                     std::to_string(times) + " subdivisions; 0 to " + std::to_string(kMaxTimes) + " are possible",
                     "subdivisions"};
    }
    std::uint32_t fitting = 0;
    while (fitting < times && (std::uint64_t{mesh.face_count()} << (2 * (fitting + 1))) <= face_limit) ++fitting;
    if (fitting == times && mesh.face_count() <= face_limit) return Done{};
    return Error{Cause::kLimitExceeded,
                 std::to_string(times) + " one-to-four subdivisions of " + std::to_string(mesh.face_count()) +
                     " faces make more than " + std::to_string(face_limit) + ", the limit; " + std::to_string(fitting) + " fit",
                 "subdivisions"};
}

}  // namespace vsplit

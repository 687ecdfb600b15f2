#include "vsplit/quality/mesh_quality.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>

#include "mesh/half_edges.h"
#include "quality/quality_of_edges.h"
#include "vsplit/quality/stretch.h"

namespace vsplit {
namespace {

std::array<Vec3, 3> corners(const TriangleMesh& mesh, std::uint32_t face) {
    const Triangle& f = mesh.faces[face];
    return {mesh.positions[f[0]], mesh.positions[f[1]], mesh.positions[f[2]]};
}

std::uint32_t largest_valence(const TriangleMesh& mesh, const EdgeIndex& edges) {
    const std::vector<std::uint32_t> valence = valences(mesh, edges);
    return valence.empty() ? 0 : *std::max_element(valence.begin(), valence.end());
}

}  // namespace

Quality measure_quality(const TriangleMesh& mesh) { return measure_quality(mesh, EdgeIndex(mesh)); }

Quality measure_quality(const TriangleMesh& mesh, const EdgeIndex& edges) {
    Quality quality;
    quality.faces = mesh.face_count();
    if (mesh.faces.empty()) return quality;
    std::vector<double> stretches(mesh.faces.size()), sizes(mesh.faces.size());
    tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, mesh.face_count(), 4096), [&](const auto& range) {
        for (std::uint32_t f = range.begin(); f < range.end(); ++f) {
            const auto [a, b, c] = corners(mesh, f);
            stretches[f] = stretch(a, b, c);
            sizes[f] = face_size(a, b, c);
        }
    });
    double sum = 0;
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
        const double s = stretches[f];
        sum += s;
        quality.faces_below_02 += s < kStretchFloor ? 1 : 0;
        quality.size_max = std::max(quality.size_max, sizes[f]);
        ++quality.stretch_histogram[std::min<std::size_t>(static_cast<std::size_t>(s * 20), 19)];
    }
    quality.stretch_mean = sum / static_cast<double>(stretches.size());
    const auto p01 = stretches.begin() + static_cast<std::ptrdiff_t>(stretches.size() / 100);
    std::nth_element(stretches.begin(), p01, stretches.end());
    quality.stretch_p01 = *p01;
    quality.stretch_min = *std::min_element(stretches.begin(), p01 + 1);
    quality.valence_max = largest_valence(mesh, edges);
    return quality;
}

std::vector<FaceQuality> worst_faces(const TriangleMesh& mesh, std::size_t count) {
    std::vector<FaceQuality> all(mesh.faces.size());
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
        const auto [a, b, c] = corners(mesh, f);
        all[f] = {f, stretch(a, b, c), face_size(a, b, c), (a + b + c) / 3};
    }
    const std::size_t kept = std::min(count, all.size());
    const auto worse = [](const FaceQuality& left, const FaceQuality& right) {
        return left.stretch != right.stretch ? left.stretch < right.stretch : left.face < right.face;
    };
    std::partial_sort(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(kept), all.end(), worse);
    all.resize(kept);
    return all;
}

}  // namespace vsplit

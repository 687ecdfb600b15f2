#include "vsplit/mesh/weld.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "base/number_text.h"
#include "mesh/drop_unused.h"
#include "mesh/exact_merger.h"
#include "mesh/merge_vertices.h"
#include "mesh/near_merger.h"
#include "vsplit/mesh/finding.h"

namespace vsplit {
namespace {

// Both keep the vertices at the front of `positions` and return each vertex's new number.

std::vector<std::uint32_t> merge_exactly(std::vector<Vec3>& positions) {
    std::vector<std::uint32_t> numbers(positions.size());
    ExactMerger merger;
    merger.reserve(positions.size());
    for (std::size_t i = 0; i < positions.size(); i += ExactMerger::kBatch) {
        const std::size_t count = std::min(ExactMerger::kBatch, positions.size() - i);
        merger.merge(&positions[i], count, positions.data(), &numbers[i]);
    }
    positions.resize(merger.kept_count());
    return numbers;
}

std::vector<std::uint32_t> merge_near(std::vector<Vec3>& positions, double tolerance) {
    std::vector<std::uint32_t> numbers(positions.size());
    NearMerger merger(tolerance, positions.size());
    std::uint32_t kept = 0;
    for (std::size_t i = 0; i < positions.size(); ++i) {
        const Vec3 point = positions[i];
        numbers[i] = merger.merge(point, kept, positions);
        if (numbers[i] == kept) positions[kept++] = point;
    }
    positions.resize(kept);
    return numbers;
}

}  // namespace

std::vector<std::uint32_t> merge_vertices(std::vector<Vec3>& positions, double tolerance) {
    return tolerance == 0 ? merge_exactly(positions) : merge_near(positions, tolerance);
}

Expected<WeldCounts> weld(TriangleMesh& mesh, double tolerance) {
    if (!(tolerance >= 0) || std::isinf(tolerance)) {
        return Error{Cause::kInvalidOption,
                     "weld tolerance is " + number_text(tolerance) + "; a finite length of 0 or more is needed", "weld"};
    }
    const std::vector<Vec3> before = tolerance > 0 ? mesh.positions : std::vector<Vec3>();
    const std::size_t vertices = mesh.positions.size();
    const std::vector<std::uint32_t> numbers = merge_vertices(mesh.positions, tolerance);
    for (Triangle& face : mesh.faces) {
        for (std::uint32_t& vertex : face) vertex = numbers[vertex];
    }
    const auto merged = static_cast<std::uint32_t>(vertices - mesh.positions.size());
    std::vector<Vec3> near_places;
    std::uint32_t near = 0;
    for (std::size_t v = 0; v < before.size(); ++v) {
        if (before[v] == mesh.positions[numbers[v]]) continue;
        if (near++ < Finding::kExamples) near_places.push_back(before[v]);
    }
    WeldCounts counts = drop_unused(mesh);
    counts.merged_vertices = merged;
    counts.near_vertices = near;
    counts.near_places = std::move(near_places);
    return counts;
}

}  // namespace vsplit

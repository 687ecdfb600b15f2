#include "io/group_runs.h"

#include <algorithm>
#include <map>
#include <string>
#include <utility>

namespace vsplit {

void GroupRuns::give_to(TriangleMesh& mesh) const {
    std::map<std::string_view, std::uint32_t> numbers{{{}, 0}};
    std::vector<std::uint32_t> regions(mesh.faces.size(), 0);
    std::vector<FaceSet> sets;
    for (std::size_t i = 0; i < runs_.size(); ++i) {
        const std::uint32_t first = runs_[i].first_face;
        const std::uint32_t last = i + 1 < runs_.size() ? runs_[i + 1].first_face : mesh.face_count();
        if (first == last) continue;
        const auto [number, is_new] = numbers.try_emplace(runs_[i].name, static_cast<std::uint32_t>(numbers.size()));
        if (is_new) sets.push_back({std::string(runs_[i].name), {number->second}});
        std::fill(regions.begin() + first, regions.begin() + last, number->second);
    }
    const bool one =
        regions.empty() || std::all_of(regions.begin(), regions.end(), [&](std::uint32_t r) { return r == regions[0]; });
    if (one) return;
    mesh.regions = std::move(regions);
    mesh.sets = std::move(sets);
}

}  // namespace vsplit

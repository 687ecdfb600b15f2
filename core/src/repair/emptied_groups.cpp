#include <algorithm>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "base/quoted.h"
#include "repair/steps.h"

namespace vsplit {
namespace {

struct RegionFaces {
    std::uint32_t first = 0;
    std::uint32_t count = 0;
};

std::map<std::uint32_t, RegionFaces> faces_of_regions(const TriangleMesh& mesh) {
    std::map<std::uint32_t, RegionFaces> faces;
    for (std::uint32_t f = 0; f < mesh.regions.size(); ++f) {
        RegionFaces& mine = faces.try_emplace(mesh.regions[f], RegionFaces{f, 0}).first->second;
        ++mine.count;
    }
    return faces;
}

}  // namespace

void report_emptied_groups(Draft& draft, const TriangleMesh& input) {
    const std::map<std::uint32_t, RegionFaces> before = faces_of_regions(input);
    const std::set<std::uint32_t> left(draft.mesh.regions.begin(), draft.mesh.regions.end());
    const auto report = [&](const std::vector<std::uint32_t>& regions, const std::string& of) {
        RegionFaces all;
        for (const std::uint32_t region : regions) {
            const auto found = before.find(region);
            if (found == before.end()) continue;
            all.first = all.count == 0 ? found->second.first : std::min(all.first, found->second.first);
            all.count += found->second.count;
        }
        if (all.count == 0) return;
        const Triangle& t = input.faces[all.first];
        const Vec3 place = (input.positions[t[0]] + input.positions[t[1]] + input.positions[t[2]]) / 3;
        draft.changes.add_loss(Finding::Kind::kEmptiedGroup, place, all.first, of, all.count);
    };
    std::set<std::uint32_t> in_sets;
    for (std::size_t s = 0; s < input.sets.size(); ++s) {
        in_sets.insert(input.sets[s].regions.begin(), input.sets[s].regions.end());
        const std::vector<std::uint32_t>& now = draft.mesh.sets[s].regions;  // those it had, and unions
        if (std::none_of(now.begin(), now.end(), [&](std::uint32_t region) { return left.count(region) != 0; }))
            report(input.sets[s].regions, quoted(input.sets[s].name));
    }
    for (const auto& [region, faces] : before) {
        if (region != 0 && in_sets.count(region) == 0 && left.count(region) == 0)
            report({region}, "region " + std::to_string(region));
    }
}

}  // namespace vsplit

#include "mesh/weld_findings.h"

#include <algorithm>
#include <string>

#include "base/quoted.h"

namespace vsplit {
namespace {

/// The first few, and whether there are more.
std::string listed(const std::vector<std::string>& names) {
    constexpr std::size_t kShown = 10;
    std::string text;
    for (std::size_t i = 0; i < std::min(names.size(), kShown); ++i) text.append(i == 0 ? "" : ", ").append(names[i]);
    return names.size() > kShown ? text + ", ..." : text;
}

}  // namespace

std::vector<Finding> weld_findings(const WeldCounts& weld) {
    std::vector<Finding> findings;
    const auto report = [&](Finding::Kind kind, std::size_t count, const std::string& what, const std::vector<Vec3>& places) {
        if (count == 0) return;
        findings.push_back({kind, static_cast<std::uint32_t>(count), std::to_string(count) + " " + what, {}, places});
    };
    report(Finding::Kind::kUnusedVertex, weld.unused_vertices, "vertices that no face used were dropped", {});
    report(Finding::Kind::kCollapsedFace, weld.collapsed_faces, "faces with two equal corners after the weld were dropped",
           weld.collapsed_places);
    std::vector<std::string> sets, regions;
    for (const std::string& name : weld.unused_sets) sets.push_back(quoted(name));
    for (const std::uint32_t region : weld.emptied_regions) regions.push_back("region " + std::to_string(region));
    report(Finding::Kind::kUnusedSet, sets.size(), "sets that no face is in were dropped: " + listed(sets), {});
    report(Finding::Kind::kMergedVertex, weld.near_vertices, "vertices were merged with one within the weld's tolerance",
           weld.near_places);
    report(Finding::Kind::kEmptiedGroup, regions.size(), "regions in no set lost all their faces to the weld: " + listed(regions),
           {});
    return findings;
}

}  // namespace vsplit

#include "vsplit/mesh/face_groups.h"

#include <algorithm>
#include <utility>

namespace vsplit {
namespace {

struct RegionSize {
    std::uint32_t region = 0;
    std::uint32_t faces = 0;
    bool in_set = false;
};

/// How many faces each region has, by id.
std::vector<RegionSize> sizes_of_regions(std::vector<std::uint32_t> regions) {
    std::sort(regions.begin(), regions.end());
    std::vector<RegionSize> sizes;
    for (const std::uint32_t region : regions) {
        if (sizes.empty() || sizes.back().region != region) sizes.push_back({region});
        ++sizes.back().faces;
    }
    return sizes;
}

/// A set of regions that no face has is a group too, without faces.
FaceGroup group_of(const FaceSet& set, std::vector<RegionSize>& sizes) {
    std::vector<std::uint32_t> regions = set.regions;
    std::sort(regions.begin(), regions.end());
    regions.erase(std::unique(regions.begin(), regions.end()), regions.end());
    FaceGroup group{set.name, {}, 0};
    for (const std::uint32_t region : regions) {
        if (group.regions.size() < FaceGroup::kRegions) group.regions.push_back(region);
        const auto at = std::lower_bound(sizes.begin(), sizes.end(), region,
                                         [](const RegionSize& known, std::uint32_t sought) { return known.region < sought; });
        if (at == sizes.end() || at->region != region) continue;
        group.faces += at->faces;
        at->in_set = true;
    }
    return group;
}

void add(FaceGroup group, FaceGroups& groups) {
    if (groups.count++ < FaceGroups::kListed) groups.listed.push_back(std::move(group));
}

}  // namespace

FaceGroups list_groups(const TriangleMesh& mesh) {
    FaceGroups groups;
    std::vector<RegionSize> sizes = sizes_of_regions(mesh.regions);
    for (const FaceSet& set : mesh.sets) add(group_of(set, sizes), groups);
    for (const RegionSize& size : sizes) {
        if (!size.in_set) add({{}, {size.region}, size.faces}, groups);
    }
    return groups;
}

}  // namespace vsplit

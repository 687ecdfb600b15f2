#include "io/physical_groups.h"

#include <algorithm>
#include <set>

namespace vsplit {

std::uint32_t PhysicalGroups::combination(std::span<const std::uint32_t> groups) {
    if (groups.empty()) return 0;
    std::vector<std::uint32_t> ascending(groups.begin(), groups.end());
    std::sort(ascending.begin(), ascending.end());
    ascending.erase(std::unique(ascending.begin(), ascending.end()), ascending.end());
    const auto [found, is_new] = numbers_.try_emplace(std::move(ascending), static_cast<std::uint32_t>(combinations_.size()));
    if (is_new) combinations_.emplace_back(groups.begin(), groups.end());
    return found->second;
}

std::vector<std::uint32_t> PhysicalGroups::numbers(std::span<const std::uint32_t> used) const {
    std::set<std::uint32_t> taken;
    std::uint32_t largest = 0;
    for (const std::uint32_t c : used) {
        const std::vector<std::uint32_t>& groups = combinations_[c];
        if (groups.size() == 1) taken.insert(groups.front());
        for (const std::uint32_t group : groups) largest = std::max(largest, group);
    }
    std::vector<std::uint32_t> numbers(combinations_.size(), 0);
    for (const std::uint32_t c : used) {
        const std::vector<std::uint32_t>& groups = combinations_[c];
        if (groups.size() < 2) {
            if (!groups.empty()) numbers[c] = groups.front();
            continue;
        }
        const auto own = std::find_if(groups.begin(), groups.end(), [&](std::uint32_t group) { return taken.count(group) == 0; });
        numbers[c] = own == groups.end() ? ++largest : *own;
        taken.insert(numbers[c]);
    }
    return numbers;
}

void PhysicalGroups::apply(TriangleMesh& mesh) const {
    const std::set<std::uint32_t> in_use(mesh.regions.begin(), mesh.regions.end());
    const std::vector<std::uint32_t> used(in_use.begin(), in_use.end());
    const std::vector<std::uint32_t> region = numbers(used);
    std::map<std::uint32_t, std::string> called = names_;
    std::map<std::uint32_t, std::vector<std::uint32_t>> regions_of;
    for (const std::uint32_t c : used) {
        for (const std::uint32_t group : combinations_[c]) {
            regions_of[group].push_back(region[c]);
        }
    }
    // Without a name, one that is a region needs no set.
    for (const auto& [group, regions] : regions_of) {
        if (regions != std::vector<std::uint32_t>{group}) called.try_emplace(group, "physical_" + std::to_string(group));
    }
    for (const auto& [group, name] : called) {
        const auto regions = regions_of.find(group);
        mesh.sets.push_back({name, regions == regions_of.end() ? std::vector<std::uint32_t>() : regions->second});
    }
    for (std::uint32_t& r : mesh.regions) r = region[r];
}

}  // namespace vsplit

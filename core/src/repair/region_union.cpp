#include "repair/region_union.h"

#include <algorithm>
#include <iterator>

#include "base/quoted.h"

namespace vsplit {
namespace {

/// The number behind the largest, or the least one that is free where that is the largest there is.
std::uint32_t free_number(const std::set<std::uint32_t>& taken) {
    if (taken.empty()) return 0;
    if (const std::uint32_t behind = *taken.rbegin() + 1; behind != 0) return behind;
    std::uint32_t number = 0;
    for (const std::uint32_t region : taken) number += region == number ? 1 : 0;
    return number;
}

}  // namespace

RegionUnion::RegionUnion(TriangleMesh& mesh) : mesh_(mesh), taken_(mesh.regions.begin(), mesh.regions.end()) {
    for (std::uint32_t s = 0; s < mesh.sets.size(); ++s) {
        for (const std::uint32_t region : mesh.sets[s].regions) {
            taken_.insert(region);
            Sets& sets = sets_of_[region];
            if (sets.empty() || sets.back() != s) sets.push_back(s);
        }
    }
    for (const auto& [region, sets] : sets_of_) region_of_.try_emplace(sets, region);
}

const RegionUnion::Sets& RegionUnion::sets_of(std::uint32_t region) const {
    static const Sets none;
    const auto found = sets_of_.find(region);
    return found == sets_of_.end() ? none : found->second;
}

RegionUnion::Joined RegionUnion::join(std::uint32_t kept, std::uint32_t dropped) {
    if (kept == dropped) return {kept};
    const Sets& mine = sets_of(kept);
    const Sets& other = sets_of(dropped);
    if (other.empty()) return {kept, true, dropped};
    if (std::includes(mine.begin(), mine.end(), other.begin(), other.end())) return {kept};
    Sets both;
    std::set_union(mine.begin(), mine.end(), other.begin(), other.end(), std::back_inserter(both));
    const bool loses = mine.empty();
    if (const auto found = region_of_.find(both); found != region_of_.end()) return {found->second, loses, kept};
    const std::uint32_t region = free_number(taken_);
    taken_.insert(region);
    for (const std::uint32_t s : both) mesh_.sets[s].regions.push_back(region);
    region_of_.emplace(both, region);
    sets_of_.emplace(region, std::move(both));
    return {region, loses, kept};
}

std::string RegionUnion::label(std::uint32_t region) const {
    constexpr std::size_t kShown = 4;
    const Sets& sets = sets_of(region);
    if (sets.empty()) return "region " + std::to_string(region);
    std::string text;
    for (std::size_t i = 0; i < std::min(sets.size(), kShown); ++i)
        text.append(i == 0 ? "" : ", ").append(quoted(mesh_.sets[sets[i]].name));
    return sets.size() > kShown ? text + ", ..." : text;
}

}  // namespace vsplit

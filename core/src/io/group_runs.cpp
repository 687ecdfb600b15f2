#include "io/group_runs.h"

#include <algorithm>

namespace vsplit {

void GroupRuns::begin(std::span<const std::string_view> names, std::uint32_t first_face) {
    Groups groups;
    for (const std::string_view name : names) {
        if (name.empty()) continue;
        auto known = names_.find(name);
        if (known == names_.end()) known = names_.emplace(name, static_cast<std::uint32_t>(names_.size())).first;
        groups.push_back(known->second);
    }
    std::sort(groups.begin(), groups.end());
    groups.erase(std::unique(groups.begin(), groups.end()), groups.end());
    const auto number = static_cast<std::uint32_t>(groups_.size());
    const std::uint32_t mine = groups_.try_emplace(std::move(groups), number).first->second;
    if (!runs_.empty() && runs_.back().first_face == first_face) runs_.pop_back();  // it has no faces
    runs_.push_back({mine, first_face});
}

void GroupRuns::give_to(TriangleMesh& mesh, Lone lone) const {
    std::vector<const Groups*> members(groups_.size());
    for (const auto& [groups, number] : groups_) members[number] = &groups;
    std::vector<const std::string*> names(names_.size());
    for (const auto& [name, number] : names_) names[number] = &name;

    std::vector<std::uint32_t> region_of(groups_.size(), 0);
    std::map<std::uint32_t, std::size_t> set_of;  // by number of name
    std::vector<std::uint32_t> regions(mesh.faces.size(), 0);
    std::vector<FaceSet> sets;
    std::uint32_t count = 0;
    for (std::size_t i = 0; i < runs_.size(); ++i) {
        const auto& [groups, first] = runs_[i];
        const std::uint32_t last = i + 1 < runs_.size() ? runs_[i + 1].first_face : mesh.face_count();
        if (first == last || members[groups]->empty()) continue;
        std::uint32_t& region = region_of[groups];
        if (region == 0) {
            region = ++count;
            for (const std::uint32_t name : *members[groups]) {
                const auto [set, is_new] = set_of.try_emplace(name, sets.size());
                if (is_new) sets.push_back({*names[name], {}});
                sets[set->second].regions.push_back(region);
            }
        }
        std::fill(regions.begin() + first, regions.begin() + last, region);
    }
    const bool all_in_one = std::find(regions.begin(), regions.end(), 0) == regions.end() && count == 1;
    if (count == 0 || (all_in_one && lone == Lone::kIsNone)) return;
    mesh.regions = std::move(regions);
    mesh.sets = std::move(sets);
}

}  // namespace vsplit

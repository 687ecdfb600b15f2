#include "io/named_regions.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <set>

#include "io/text_lines.h"
#include "io/writers.h"

namespace vsplit {
namespace {

/// CalculiX and Abaqus take 80 characters; the rest is for a number here and what a deck hangs on.
constexpr std::size_t kLongestName = 60;

/// Names in upper case, and the number that the last one of each name got: tried again from 2 on, many alike would take forever.
using Taken = std::map<std::string, int>;

std::string solver_name(const std::string& name, Taken& taken) {
    std::string good = name;
    for (char& c : good) {
        const bool keeps = std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-' || c == '.';
        if (!keeps) c = '_';
    }
    good.resize(std::min(good.size(), kLongestName));
    if (good.empty() || std::isalpha(static_cast<unsigned char>(good.front())) == 0) good.insert(0, "S_");
    const auto [known, is_new] = taken.try_emplace(upper_case(good), 1);
    if (is_new) return good;
    std::string different;
    do {
        different = good + "_" + std::to_string(++known->second);
    } while (!taken.try_emplace(upper_case(different), 1).second);
    return different;
}

}  // namespace

std::vector<NamedRegion> named_regions(const TriangleMesh& mesh) {
    std::map<std::uint32_t, NamedRegion> regions;
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
        const std::uint32_t region = mesh.regions.empty() ? 0 : mesh.regions[f];
        regions[region].faces.push_back(f);
    }
    for (const FaceSet& s : mesh.sets) {
        const auto found = s.regions.size() == 1 ? regions.find(s.regions.front()) : regions.end();
        if (found == regions.end() || found->second.has_name) continue;
        found->second.name = s.name;
        found->second.has_name = true;
    }
    std::vector<NamedRegion> result;
    for (auto& [id, region] : regions) {
        region.region = id;
        if (!region.has_name) region.name = mesh.regions.empty() ? "all" : "region_" + std::to_string(id);
        result.push_back(std::move(region));
    }
    return result;
}

FacesOfRegions faces_of_regions(const TriangleMesh& mesh) {
    FacesOfRegions faces;
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) faces[mesh.regions[f]].push_back(f);
    return faces;
}

std::vector<std::uint32_t> faces_of_set(const FaceSet& set, const FacesOfRegions& of_regions) {
    std::vector<std::uint32_t> faces;
    for (const std::uint32_t region : std::set(set.regions.begin(), set.regions.end())) {
        const auto found = of_regions.find(region);
        if (found != of_regions.end()) faces.insert(faces.end(), found->second.begin(), found->second.end());
    }
    std::sort(faces.begin(), faces.end());
    return faces;
}

std::optional<TriangleMesh> with_regions_up_to(std::uint32_t largest, const TriangleMesh& mesh) {
    std::set<std::uint32_t> used(mesh.regions.begin(), mesh.regions.end());
    if (used.empty() || *used.rbegin() <= largest) return {};
    used.insert(0);
    std::map<std::uint32_t, std::uint32_t> number;
    for (const std::uint32_t region : used) {
        const auto next = static_cast<std::uint32_t>(number.size());
        number[region] = next <= largest ? next : 0;
    }
    TriangleMesh small = mesh;
    for (std::uint32_t& region : small.regions) region = number[region];
    small.sets = sets_with_faces(mesh);
    for (FaceSet& set : small.sets) {
        std::erase_if(set.regions, [&](std::uint32_t region) { return used.count(region) == 0; });
        for (std::uint32_t& region : set.regions) region = number[region];
    }
    return small;
}

std::vector<FaceSet> sets_with_faces(const TriangleMesh& mesh) {
    const std::set<std::uint32_t> used(mesh.regions.begin(), mesh.regions.end());
    std::vector<FaceSet> sets = mesh.sets;
    std::erase_if(sets, [&](const FaceSet& s) {
        return std::none_of(s.regions.begin(), s.regions.end(), [&](std::uint32_t region) { return used.count(region) > 0; });
    });
    return sets;
}

std::vector<FaceSet> sets_for_solvers(const TriangleMesh& mesh) {
    std::vector<FaceSet> sets = sets_with_faces(mesh);
    std::set<std::uint32_t> named{0};
    for (const FaceSet& s : sets) named.insert(s.regions.begin(), s.regions.end());
    for (const NamedRegion& region : named_regions(mesh)) {
        if (named.count(region.region) == 0) sets.push_back({region.name, {region.region}});
    }
    Taken taken{{upper_case(kAllElements), 1}};
    for (FaceSet& s : sets) s.name = solver_name(s.name, taken);
    return sets;
}

}  // namespace vsplit

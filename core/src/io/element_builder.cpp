#include "io/element_builder.h"

#include <algorithm>
#include <map>
#include <set>

#include "io/cut_polygon.h"
#include "io/mesh_builder.h"
#include "io/text_lines.h"

namespace vsplit {

Status ElementBuilder::add_node(std::int64_t id, const Vec3& position, Place place) {
    if (Status valid = check_position(position, place); !valid) return valid;
    if (Status few = check_vertex_limit(mesh_.positions.size() + 1, max_faces_, place); !few) return few;
    unit_ = place.unit;
    nodes_.push_back({id, mesh_.vertex_count()});
    node_places_.push_back(place.number);
    mesh_.positions.push_back(position);
    return Done{};
}

Status ElementBuilder::add_element(std::int64_t id, std::span<const std::int64_t> corners, Place place, std::uint32_t region) {
    if (Status fits = check_face_limit(corners_.size() + corners.size() - 2, max_faces_, place); !fits) return fits;
    unit_ = place.unit;
    for (std::size_t i = 2; i < corners.size(); ++i) {
        corners_.push_back({{corners[0], corners[i - 1], corners[i]}, id, place.number});
        mesh_.regions.push_back(region);
    }
    return Done{};
}

std::optional<std::size_t> ElementBuilder::find_set(const std::string& name) const {
    const auto found = set_numbers_.find(upper_case(name));
    return found == set_numbers_.end() ? std::nullopt : std::optional(found->second);
}

ElementBuilder::Set& ElementBuilder::set(const std::string& name) {
    const auto [found, is_new] = set_numbers_.try_emplace(upper_case(name), sets_.size());
    return is_new ? sets_.emplace_back(Set{name, {}, {}}) : sets_[found->second];
}

/// One by one, as most files name them, elements that follow each other are one range; a range that may be wrong is of one place.
void ElementBuilder::add_one(const std::string& name, std::int64_t id, Place place, Must must) {
    std::vector<Range>& ranges = set(name).ranges;
    const bool goes_on = !ranges.empty() && ranges.back().must == must && ranges.back().last + 1 == id &&
                         (must == Must::kNothing || ranges.back().place == place.number);
    if (goes_on) {
        ranges.back().last = id;
    } else {
        ranges.push_back({id, id, 1, place.number, must});
    }
}

void ElementBuilder::define_in_set(const std::string& name, std::int64_t id, Place place) {
    add_one(name, id, place, Must::kNothing);
}

void ElementBuilder::add_to_set(const std::string& name, std::int64_t id, Place place) {
    add_one(name, id, place, Must::kAllExist);
}

void ElementBuilder::add_range_to_set(const std::string& name, std::int64_t first, std::int64_t last, std::int64_t step,
                                      Place place) {
    set(name).ranges.push_back({first, last, step, place.number, Must::kOneExists});
}

void ElementBuilder::add_set_to_set(const std::string& name, const std::string& other, Place place) {
    set(name).others.push_back({other, place.number, kNobody});
}

void ElementBuilder::name_region(const std::string& name, std::uint32_t region) {
    const auto [found, is_new] = region_names_.try_emplace(name, mesh_.sets.size());
    if (is_new) mesh_.sets.push_back({name, {}});
    mesh_.sets[found->second].regions.push_back(region);
}

Status ElementBuilder::sort_nodes() {
    const auto by_id = [](const Node& l, const Node& r) { return std::pair(l.id, l.index) < std::pair(r.id, r.index); };
    if (!std::is_sorted(nodes_.begin(), nodes_.end(), by_id)) std::sort(nodes_.begin(), nodes_.end(), by_id);
    for (std::size_t i = 1; i < nodes_.size(); ++i) {
        const Node& first = nodes_[i - 1];
        const Node& second = nodes_[i];
        if (first.id != second.id || mesh_.positions[first.index] == mesh_.positions[second.index]) continue;
        return error_at(Cause::kMalformedInput, node_places_[second.index],
                        "node " + std::to_string(second.id) + " is defined a second time, elsewhere; first at " +
                            std::string(unit_) + " " + std::to_string(node_places_[first.index]));
    }
    return Done{};
}

std::optional<std::uint32_t> ElementBuilder::find_node(std::int64_t id) const {
    // Most files number their nodes without gaps.
    const std::int64_t guess = nodes_.empty() ? 0 : id - nodes_.front().id;
    if (guess >= 0 && guess < static_cast<std::int64_t>(nodes_.size()) && nodes_[static_cast<std::size_t>(guess)].id == id)
        return nodes_[static_cast<std::size_t>(guess)].index;
    const auto found = std::lower_bound(nodes_.begin(), nodes_.end(), id, [](const Node& n, std::int64_t i) { return n.id < i; });
    return found == nodes_.end() || found->id != id ? std::nullopt : std::optional(found->index);
}

Status ElementBuilder::number_corners() {
    mesh_.faces.reserve(corners_.size());
    for (const Corner& corner : corners_) {
        Triangle& face = mesh_.faces.emplace_back();
        for (std::size_t i = 0; i < 3; ++i) {
            const std::optional<std::uint32_t> index = find_node(corner.nodes[i]);
            if (!index) {
                return error_at(Cause::kIndexOutOfRange, corner.place,
                                "element " + std::to_string(corner.element) + " names node " + std::to_string(corner.nodes[i]) +
                                    ", which the file does not define");
            }
            face[i] = *index;
        }
    }
    return cut_elements();
}

/// Elements of more than three corners are fans up to here.
Status ElementBuilder::cut_elements() {
    for (std::size_t f = 0, end = 0; f < corners_.size(); f = end) {
        for (end = f + 1; end < corners_.size() && is_one_element(f, end); ++end) {
        }
        if (Status cut = unfold_fan(mesh_.positions, std::span(mesh_.faces).subspan(f, end - f), {unit_, corners_[f].place});
            !cut)
            return cut;
    }
    return Done{};
}

Status ElementBuilder::count_member(std::size_t place) {
    constexpr std::uint64_t kMostMemberships = 100'000'000;  // also what hostile sets that hold each other come to
    if (++memberships_ <= kMostMemberships) return Done{};
    return error_at(Cause::kLimitExceeded, place, "the sets of the file have over 100 million members");
}

Status ElementBuilder::find_others() {
    for (Set& s : sets_) {
        for (Other& other : s.others) {
            const std::optional<std::size_t> found = find_set(other.name);
            if (!found) {
                return error_at(
                    Cause::kMalformedInput, other.place,
                    "set " + quoted(s.name) + " names the set " + quoted(other.name) + ", which the file does not define");
            }
            other.number = static_cast<std::uint32_t>(*found);
        }
    }
    return Done{};
}

/// The set and all it holds, those they hold too, each once.
Status ElementBuilder::collect_members(std::uint32_t number, std::vector<std::uint32_t>& members) {
    members.assign(1, number);
    collected_for_[number] = number;
    for (std::size_t i = 0; i < members.size(); ++i) {
        for (const Other& other : sets_[members[i]].others) {
            if (Status counted = count_member(other.place); !counted) return counted;
            if (std::exchange(collected_for_[other.number], number) != number) members.push_back(other.number);
        }
    }
    return Done{};
}

Status ElementBuilder::sort_elements() {
    for (std::uint32_t f = 0; f < corners_.size(); ++f) {
        if (f == 0 || !is_one_element(f - 1, f)) elements_.push_back({corners_[f].element, f});
    }
    const auto by_id = [](const Node& l, const Node& r) { return l.id < r.id; };
    if (!std::is_sorted(elements_.begin(), elements_.end(), by_id)) std::stable_sort(elements_.begin(), elements_.end(), by_id);
    const auto twice =
        std::adjacent_find(elements_.begin(), elements_.end(), [](const Node& l, const Node& r) { return l.id == r.id; });
    if (twice == elements_.end()) return Done{};
    return error_at(Cause::kMalformedInput, corners_[std::next(twice)->index].place,
                    "element " + std::to_string(twice->id) + " is defined a second time; first at " + std::string(unit_) + " " +
                        std::to_string(corners_[twice->index].place));
}

bool ElementBuilder::is_defined(std::int64_t id) const {
    const auto face =
        std::lower_bound(elements_.begin(), elements_.end(), id, [](const Node& n, std::int64_t i) { return n.id < i; });
    return (face != elements_.end() && face->id == id) || std::binary_search(skipped_.begin(), skipped_.end(), id);
}

Status ElementBuilder::check_members() {
    std::sort(skipped_.begin(), skipped_.end());
    const auto error = [&](const Set& s, const Range& range, const std::string& what) {
        return error_at(Cause::kIndexOutOfRange, range.place, "set " + quoted(s.name) + " names " + what);
    };
    const auto on_step = [](const Range& range, std::int64_t id) {
        return id <= range.last && (id - range.first) % range.step == 0;
    };
    const auto one_exists = [&](const Range& range) {
        auto face = std::lower_bound(elements_.begin(), elements_.end(), range.first,
                                     [](const Node& n, std::int64_t id) { return n.id < id; });
        for (; face != elements_.end() && face->id <= range.last; ++face) {
            if (on_step(range, face->id)) return true;
        }
        auto other = std::lower_bound(skipped_.begin(), skipped_.end(), range.first);
        for (; other != skipped_.end() && *other <= range.last; ++other) {
            if (on_step(range, *other)) return true;
        }
        return false;
    };
    for (const Set& s : sets_) {
        for (const Range& range : s.ranges) {
            if (range.must == Must::kOneExists && !one_exists(range)) {
                return error(s, range,
                             "elements " + std::to_string(range.first) + " to " + std::to_string(range.last) +
                                 ", of which the file defines none");
            }
            for (std::int64_t id = range.first; range.must == Must::kAllExist && id <= range.last; ++id) {
                if (!is_defined(id)) return error(s, range, "element " + std::to_string(id) + ", which the file does not define");
            }
        }
    }
    return Done{};
}

Status ElementBuilder::put_into_set(const Range& range, std::uint32_t number) {
    auto at = std::lower_bound(elements_.begin(), elements_.end(), range.first,
                               [](const Node& n, std::int64_t id) { return n.id < id; });
    for (; at != elements_.end() && at->id <= range.last; ++at) {
        if (Status counted = count_member(range.place); !counted) return counted;
        if ((at->id - range.first) % range.step != 0) continue;
        for (std::uint32_t f = at->index; f < corners_.size() && corners_[f].element == at->id; ++f) {
            if (sets_of_[f].empty() || sets_of_[f].back() != number) sets_of_[f].push_back(number);
        }
    }
    return Done{};
}

Status ElementBuilder::fill_sets() {
    if (Status found = find_others(); !found) return found;
    if (Status defined = check_members(); !defined) return defined;
    sets_of_.resize(corners_.size());
    collected_for_.assign(sets_.size(), kNobody);
    std::vector<std::uint32_t> members;
    for (std::uint32_t number = 0; number < sets_.size(); ++number) {
        if (Status collected = collect_members(number, members); !collected) return collected;
        for (const std::uint32_t member : members) {
            for (const Range& range : sets_[member].ranges) {
                if (Status put = put_into_set(range, number); !put) return put;
            }
        }
    }
    return Done{};
}

void ElementBuilder::leave_set_of_all() {
    const std::optional<std::size_t> found = set_of_all_.empty() ? std::nullopt : find_set(set_of_all_);
    if (!found) return;
    const auto number = static_cast<std::uint32_t>(*found);
    const auto is_in = [&](const std::vector<std::uint32_t>& sets) {
        return std::binary_search(sets.begin(), sets.end(), number);
    };
    if (!std::all_of(sets_of_.begin(), sets_of_.end(), is_in)) return;
    for (std::vector<std::uint32_t>& sets : sets_of_) sets.erase(std::lower_bound(sets.begin(), sets.end(), number));
    sets_[number].name.clear();
}

void ElementBuilder::make_regions() {
    std::map<std::vector<std::uint32_t>, std::uint32_t> regions{{{}, 0}};
    mesh_.sets.clear();
    for (const Set& s : sets_) mesh_.sets.push_back({s.name, {}});  // without a name: the one of all
    for (std::uint32_t f = 0; f < corners_.size(); ++f) {
        const auto [region, is_new] = regions.try_emplace(sets_of_[f], static_cast<std::uint32_t>(regions.size()));
        mesh_.regions[f] = region->second;
        if (!is_new) continue;
        for (const std::uint32_t number : sets_of_[f]) mesh_.sets[number].regions.push_back(region->second);
    }
    std::erase_if(mesh_.sets, [](const FaceSet& s) { return s.name.empty(); });
}

/// Regions that no face has; and where no face has a region at all, the regions. Sets without a face stay: who reads tells of
/// them.
void ElementBuilder::drop_empty_regions() {
    const std::set<std::uint32_t> used(mesh_.regions.begin(), mesh_.regions.end());
    for (FaceSet& s : mesh_.sets) std::erase_if(s.regions, [&](std::uint32_t region) { return used.count(region) == 0; });
    const bool no_set = std::all_of(mesh_.sets.begin(), mesh_.sets.end(), [](const FaceSet& s) { return s.regions.empty(); });
    if (no_set && used.size() <= 1 && used.count(0) == used.size()) mesh_.regions.clear();
}

Expected<TriangleMesh> ElementBuilder::take() {
    if (corners_.empty() && solids_ > 0) {
        return Error{Cause::kUnsupported,
                     "the file has " + std::to_string(solids_) +
                         " solid elements and no triangle or quadrilateral; a surface mesh is needed",
                     ""};
    }
    if (Status sorted = sort_nodes(); !sorted) return sorted.error();
    if (Status numbered = number_corners(); !numbered) return numbered.error();
    if (Status sorted = sort_elements(); !sorted) return sorted.error();
    if (!sets_.empty()) {
        if (Status filled = fill_sets(); !filled) return filled.error();
        leave_set_of_all();
        make_regions();
    }
    drop_empty_regions();
    return std::move(mesh_);
}

}  // namespace vsplit

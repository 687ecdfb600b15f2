#include "io/assembly_3mf.h"

#include <Eigen/LU>
#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "io/mesh_builder.h"
#include "io/read_error.h"
#include "io/text_lines.h"
#include "vsplit/io/read_mesh.h"

namespace vsplit {
namespace {

constexpr std::uint64_t kMostPlaced = 1'000'000;
constexpr std::uint64_t kMostMemberships = 100'000'000;  // of regions in sets
constexpr std::uint32_t kDeepest = 64;
constexpr std::uint64_t kPlenty = std::uint64_t{1} << 40U;  // counts stop growing here: sums of two fit

/// What an object comes to with all its components.
struct Extent {
    std::uint64_t vertices = 0;
    std::uint64_t faces = 0;
    std::uint64_t placed = 1;
    std::uint32_t depth = 1;

    void add(const Extent& part) {
        vertices = std::min(kPlenty, vertices + part.vertices);
        faces = std::min(kPlenty, faces + part.faces);
        placed = std::min(kPlenty, placed + part.placed);
        depth = std::max(depth, part.depth + 1);
    }
};

/// An object, and what its components are.
struct Node {
    const Model3mf* model = nullptr;
    const Object3mf* object = nullptr;
    std::vector<std::size_t> components;
    Extent extent;
};

/// First `inner`, then `outer`.
Placement3mf combined(const std::optional<Placement3mf>& outer, const std::optional<Placement3mf>& inner) {
    const Placement3mf o = outer.value_or(Placement3mf()), i = inner.value_or(Placement3mf());
    return {o.linear * i.linear, o.linear * i.shift + o.shift};
}

/// The combinations of an object's triangle sets that faces are in: cells, numbered in order of their first face; 0 are the faces
/// in no set.
struct SetCells {
    std::uint32_t count = 1;
    std::vector<std::uint32_t> of_face;
    std::vector<std::vector<std::uint32_t>> of_set;
};

/// Splits cells set by set. `count` grows with cells that are left empty; `name_cells` drops those.
void split_cells(const TriangleSet3mf& set, SetCells& cells) {
    const std::uint32_t before = cells.count;
    std::map<std::uint32_t, std::uint32_t> inside;  // a cell's part in the set
    for (const auto& [first, last] : set.ranges) {
        for (std::uint32_t f = first; f <= last; ++f) {
            std::uint32_t& cell = cells.of_face[f];
            if (cell >= before) continue;  // named twice
            const auto [part, is_new] = inside.try_emplace(cell, cells.count);
            if (is_new) ++cells.count;
            cell = part->second;
        }
    }
}

void name_cells(SetCells& cells) {
    std::map<std::uint32_t, std::uint32_t> numbers{{0, 0}};
    for (std::uint32_t& cell : cells.of_face)
        cell = numbers.try_emplace(cell, static_cast<std::uint32_t>(numbers.size())).first->second;
    cells.count = static_cast<std::uint32_t>(numbers.size());
}

SetCells cells_of(const Object3mf& object) {
    SetCells cells;
    cells.of_face.assign(object.mesh.faces.size(), 0);
    for (const TriangleSet3mf& set : object.sets) split_cells(set, cells);
    name_cells(cells);
    std::vector<std::size_t> seen_in(cells.count, 0);  // set, from 1
    for (std::size_t s = 0; s < object.sets.size(); ++s) {
        std::vector<std::uint32_t>& of_this = cells.of_set.emplace_back();
        for (const auto& [first, last] : object.sets[s].ranges) {
            for (std::uint32_t f = first; f <= last; ++f) {
                if (std::exchange(seen_in[cells.of_face[f]], s + 1) != s + 1) of_this.push_back(cells.of_face[f]);
            }
        }
    }
    return cells;
}

class Assembly {
public:
    Assembly(const std::vector<Model3mf>& models, const ReadOptions& options) : root_(models.front()), options_(options) {
        // An object names such as stand before it, and an object of the root any of other files.
        for (std::size_t m = models.size(); m-- > 0;) {
            for (const Object3mf& object : models[m].objects) nodes_.push_back({&models[m], &object, {}, {}});
        }
    }

    Expected<TriangleMesh> make() {
        for (std::size_t n = 0; n < nodes_.size(); ++n) {
            if (Status linked = link(n); !linked) return linked.error();
        }
        std::vector<std::size_t> items;
        Extent all;
        for (const Reference3mf& item : root_.items) {
            const Expected<std::size_t> node = find(root_, item, nodes_.size());
            if (!node) return node.error();
            items.push_back(*node);
            all.add(nodes_[*node].extent);
        }
        if (Status possible = check(all); !possible) return of_root(possible.error());
        mesh_.positions.reserve(static_cast<std::size_t>(all.vertices));
        mesh_.faces.reserve(static_cast<std::size_t>(all.faces));
        for (std::size_t i = 0; i < items.size(); ++i) {
            const Reference3mf& item = root_.items[i];
            if (Status placed = place(items[i], item.placement, "", item.place); !placed) return of_root(placed.error());
        }
        number_regions();
        return std::move(mesh_);
    }

private:
    /// The node that a reference of `model` means, if it is one of the first `before`.
    Expected<std::size_t> find(const Model3mf& model, const Reference3mf& reference, std::size_t before) const {
        const std::string_view part = reference.part.empty() ? model.part : std::string_view(reference.part);
        const auto key = std::pair(upper_case(part), reference.object);
        const auto found = by_id_.find(key);
        if (found != by_id_.end() && found->second < before) return found->second;
        const std::string which =
            "object " + std::to_string(reference.object) + (reference.part.empty() ? "" : " of " + reference.part);
        return error(model, reference.place, Cause::kMalformedInput,
                     which + (found == by_id_.end() ? " is not defined" : " is not defined before it is used"));
    }

    /// Finds the components of a node, and counts.
    Status link(std::size_t n) {
        Node& node = nodes_[n];
        node.extent.vertices = node.object->mesh.positions.size();
        node.extent.faces = node.object->mesh.faces.size();
        for (const Reference3mf& component : node.object->components) {
            const Expected<std::size_t> found = find(*node.model, component, n);
            if (!found) return found.error();
            node.components.push_back(*found);
            node.extent.add(nodes_[*found].extent);
        }
        if (node.object->is_support) node.extent = {};
        const bool is_new = by_id_.try_emplace({upper_case(node.model->part), node.object->id}, n).second;
        if (is_new) return Done{};
        return error(*node.model, node.object->place, Cause::kMalformedInput,
                     "object " + std::to_string(node.object->id) + " is defined a second time");
    }

    /// Before memory is taken.
    Status check(const Extent& all) const {
        const Place place = root_.items.empty() ? at_line(1) : root_.items.front().place;
        if (all.placed > kMostPlaced)
            return read_error(Cause::kLimitExceeded, place, "the build comes to over a million objects with their components");
        if (all.depth > kDeepest + 1)
            return read_error(Cause::kLimitExceeded, place, "components are over " + std::to_string(kDeepest) + " deep");
        if (all.vertices > kMaxVertices)
            return read_error(Cause::kLimitExceeded, place,
                              "the build comes to over " + std::to_string(kMaxVertices) + " vertices");
        return check_face_limit(all.faces, options_.max_faces, place);
    }

    Status place(std::size_t n, const std::optional<Placement3mf>& placement, const std::string& name, Place at) {
        const Node& node = nodes_[n];
        const Object3mf& object = *node.object;
        if (object.is_support) return Done{};
        const std::string& called = object.name.empty() ? name : object.name;
        if (!object.mesh.faces.empty()) {
            if (Status added = add_mesh(n, placement, called, at); !added) return added;
        }
        for (std::size_t i = 0; i < node.components.size(); ++i) {
            const std::optional<Placement3mf>& inner = object.components[i].placement;
            const std::optional<Placement3mf> both =
                inner || placement ? std::optional(combined(placement, inner)) : std::nullopt;
            if (Status placed = place(node.components[i], both, called, at); !placed) return placed;
        }
        return Done{};
    }

    /// `at`: of the item that puts it there.
    Status add_mesh(std::size_t n, const std::optional<Placement3mf>& placement, const std::string& name, Place at) {
        const TriangleMesh& mesh = nodes_[n].object->mesh;
        const std::uint32_t first = mesh_.vertex_count();
        const bool mirrored = placement && placement->linear.determinant() < 0;
        for (const Vec3& position : mesh.positions) {
            const Vec3 moved = placement ? Vec3(placement->linear * position + placement->shift) : position;
            if (Status valid = check_position(moved, at); !valid) return valid;
            mesh_.positions.push_back(moved);
        }
        for (const Triangle& face : mesh.faces) {
            const Triangle there{first + face[0], first + face[1], first + face[2]};
            mesh_.faces.push_back(mirrored ? Triangle{there[0], there[2], there[1]} : there);
        }
        return add_regions(n, name.empty() ? "object_" + std::to_string(nodes_[n].object->id) : name, at);
    }

    /// Temporary ones: those of an object under a name stand together, a cell each.
    Status add_regions(std::size_t n, const std::string& name, Place at) {
        auto known = cells_.find(n);
        if (known == cells_.end()) known = cells_.try_emplace(n, cells_of(*nodes_[n].object)).first;
        const SetCells& cells = known->second;
        const auto [begin, is_new] = begins_.try_emplace({n, name}, regions_);
        if (is_new) {
            regions_ += cells.count;
            for (std::uint32_t cell = 0; cell < cells.count; ++cell) put_into_set({name, true}, begin->second + cell);
            for (std::size_t s = 0; s < cells.of_set.size(); ++s) {
                for (const std::uint32_t cell : cells.of_set[s])
                    put_into_set({nodes_[n].object->sets[s].name, false}, begin->second + cell);
            }
            if (memberships_ > kMostMemberships)
                return read_error(Cause::kLimitExceeded, at, "the sets of the build have over 100 million members");
        }
        for (const std::uint32_t cell : cells.of_face) mesh_.regions.push_back(begin->second + cell);
        return Done{};
    }

    /// A set by its name, and whether it is that of an object.
    void put_into_set(const std::pair<std::string, bool>& key, std::uint32_t region) {
        const auto [at, is_new] = set_numbers_.try_emplace(key, mesh_.sets.size());
        if (is_new) {
            mesh_.sets.push_back({key.first, {}});
            of_object_.push_back(key.second);
        }
        mesh_.sets[at->second].regions.push_back(region);
        ++memberships_;
    }

    /// Numbers from 1 in order of the first face; one object alone names no region.
    void number_regions() {
        constexpr std::uint32_t kNone = 0xFFFFFFFF;
        std::vector<std::uint32_t> numbers(regions_, kNone);
        const bool one = begins_.size() == 1;
        if (one) numbers[0] = 0;
        std::uint32_t next = 1;
        for (std::uint32_t& region : mesh_.regions) {
            if (numbers[region] == kNone) numbers[region] = next++;
            region = numbers[region];
        }
        std::vector<FaceSet> sets;
        for (std::size_t s = 0; s < mesh_.sets.size(); ++s) {
            if (one && of_object_[s]) continue;
            FaceSet& set = sets.emplace_back(FaceSet{mesh_.sets[s].name, {}});
            for (const std::uint32_t region : mesh_.sets[s].regions) {
                if (numbers[region] != kNone) set.regions.push_back(numbers[region]);
            }
            std::sort(set.regions.begin(), set.regions.end());
            set.regions.erase(std::unique(set.regions.begin(), set.regions.end()), set.regions.end());
            if (set.regions.empty()) sets.pop_back();
        }
        mesh_.sets = std::move(sets);
        if (mesh_.sets.empty()) mesh_.regions.clear();
    }

    static Error error(const Model3mf& model, Place at, Cause cause, const std::string& what) {
        return in_part(model, read_error(cause, at, what));
    }
    [[nodiscard]] Error of_root(const Error& error) const { return in_part(root_, error); }
    static Error in_part(const Model3mf& model, Error error) {
        error.message = model.part + ", " + error.message;
        return error;
    }

    const Model3mf& root_;
    const ReadOptions& options_;
    std::vector<Node> nodes_;
    std::map<std::pair<std::string, std::uint64_t>, std::size_t> by_id_;  // of those linked
    TriangleMesh mesh_;
    std::map<std::size_t, SetCells> cells_;                                // of nodes with a mesh
    std::map<std::pair<std::size_t, std::string>, std::uint32_t> begins_;  // first region of a node under a name
    std::uint32_t regions_ = 0;
    std::map<std::pair<std::string, bool>, std::size_t> set_numbers_;
    std::vector<bool> of_object_;  // of each set
    std::uint64_t memberships_ = 0;
};

}  // namespace

Expected<TriangleMesh> assemble_3mf(const std::vector<Model3mf>& models, const ReadOptions& options) {
    return Assembly(models, options).make();
}

}  // namespace vsplit

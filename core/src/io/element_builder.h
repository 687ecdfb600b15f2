#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "io/read_error.h"
#include "vsplit/base/expected.h"
#include "vsplit/mesh/triangle_mesh.h"

namespace vsplit {

/// The largest number of a node or an element: differences of two fit an integer.
inline constexpr std::int64_t kLargestId = std::int64_t{1} << 62;

/// Collects a mesh whose nodes and elements have numbers of their own, in any order and with gaps, as solvers have them, and
/// whose elements belong to any number of named sets.
class ElementBuilder {
public:
    explicit ElementBuilder(std::uint32_t max_faces) : max_faces_(max_faces) {}

    /// \return INVALID_COORDINATE, LIMIT_EXCEEDED.
    [[nodiscard]] Status add_node(std::int64_t id, const Vec3& position, Place place);

    /// A flat element by its corners (mid-side nodes are the caller's to leave out); 4 and more are cut into a fan.
    /// \return LIMIT_EXCEEDED. `region`: see take.
    [[nodiscard]] Status add_element(std::int64_t id, std::span<const std::int64_t> corners, Place place,
                                     std::uint32_t region = 0);

    /// An element with a volume: it has no place in a surface mesh. Files with nothing else are refused.
    void skip_solid() { ++solids_; }
    /// An element without a face: sets may hold it all the same.
    void skip_element(std::int64_t id) { skipped_.push_back(id); }

    /// There is a set of this name, of no elements so far.
    void add_set(const std::string& name) { static_cast<void>(set(name)); }
    /// An element is in the set where it is defined.
    void define_in_set(const std::string& name, std::int64_t id, Place place);
    /// An element that must be defined somewhere is in the set.
    void add_to_set(const std::string& name, std::int64_t id, Place place);
    /// Elements `first` to `last` are in the set; one at least must be defined.
    void add_range_to_set(const std::string& name, std::int64_t first, std::int64_t last, std::int64_t step, Place place);
    /// The elements of another set are in the set, those it gets later too.
    void add_set_to_set(const std::string& name, const std::string& other, Place place);

    /// A set of this name says nothing where all faces are in it, as decks have one for sections to name; then there is none.
    void ignore_set_of_all(std::string_view name) { set_of_all_ = name; }

    /// Names a region given with elements.
    void name_region(const std::string& name, std::uint32_t region);

    /// The mesh. Where sets have members, faces that are in the same sets are a region, numbered from 1 in order of their first
    /// face, and 0 are those in none; else regions are those given with the elements, none when all are 0.
    /// \return INDEX_OUT_OF_RANGE for a node, or an element of a set, that does not exist; MALFORMED_INPUT for an element that is
    /// defined twice, a node that is so in different places, or an unknown set; UNSUPPORTED for a file of solids; LIMIT_EXCEEDED.
    [[nodiscard]] Expected<TriangleMesh> take();

private:
    struct Node {
        std::int64_t id = 0;
        std::uint32_t index = 0;
    };
    struct Corner {
        std::array<std::int64_t, 3> nodes{};
        std::int64_t element = 0;
        std::size_t place = 0;
    };
    enum class Must { kNothing, kAllExist, kOneExists };  ///< what is asked of the elements of a range
    struct Range {
        std::int64_t first = 0;
        std::int64_t last = 0;
        std::int64_t step = 1;
        std::size_t place = 0;
        Must must = Must::kNothing;
    };
    struct Other {
        std::string name;
        std::size_t place = 0;     // where it is named
        std::uint32_t number = 0;  // of the set, once all are known
    };
    struct Set {
        std::string name;
        std::vector<Range> ranges;
        std::vector<Other> others;
    };

    [[nodiscard]] Set& set(const std::string& name);
    [[nodiscard]] std::optional<std::size_t> find_set(const std::string& name) const;
    [[nodiscard]] Status sort_nodes();
    [[nodiscard]] std::optional<std::uint32_t> find_node(std::int64_t id) const;
    [[nodiscard]] Status number_corners();
    [[nodiscard]] Status cut_elements();
    /// Two triangles of one element, not of two with the same number.
    [[nodiscard]] bool is_one_element(std::size_t f, std::size_t g) const {
        return corners_[f].element == corners_[g].element && corners_[f].place == corners_[g].place;
    }
    [[nodiscard]] Status count_member(std::size_t place);
    [[nodiscard]] Status find_others();
    [[nodiscard]] Status collect_members(std::uint32_t set, std::vector<std::uint32_t>& members);
    [[nodiscard]] Status sort_elements();
    void add_one(const std::string& name, std::int64_t id, Place place, Must must);
    [[nodiscard]] bool is_defined(std::int64_t id) const;
    [[nodiscard]] Status check_members();
    [[nodiscard]] Status put_into_set(const Range& range, std::uint32_t number);
    [[nodiscard]] Status fill_sets();
    void leave_set_of_all();
    void make_regions();
    void drop_empty_regions();
    [[nodiscard]] Error error_at(Cause cause, std::size_t place, const std::string& what) const {
        return read_error(cause, {unit_, place}, what);
    }

    std::uint32_t max_faces_;
    std::string_view unit_ = "line";
    TriangleMesh mesh_;
    std::vector<Node> nodes_;
    std::vector<std::size_t> node_places_;
    std::vector<Corner> corners_;
    std::vector<Node> elements_;         // id and first face, ascending by id
    std::vector<std::int64_t> skipped_;  // elements without a face
    std::vector<Set> sets_;
    std::map<std::string, std::size_t> set_numbers_;   // by name in upper case
    std::vector<std::vector<std::uint32_t>> sets_of_;  // of each face, ascending
    static constexpr std::uint32_t kNobody = 0xFFFFFFFF;
    std::vector<std::uint32_t> collected_for_;         // by set: the last one it was collected for
    std::map<std::string, std::size_t> region_names_;  // and their places in the mesh's sets
    std::string set_of_all_;
    std::uint64_t memberships_ = 0;
    std::uint64_t solids_ = 0;
};

}  // namespace vsplit

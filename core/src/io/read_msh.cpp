#include <algorithm>
#include <array>
#include <cstdlib>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "io/element_builder.h"
#include "io/number_stream.h"
#include "io/physical_groups.h"
#include "io/read_error.h"
#include "io/readers.h"
#include "io/text_lines.h"

namespace vsplit {
namespace {

using Kind = NumberStream::Kind;

/// Of Gmsh's element types: nodes, corners where it is a face, dimension.
struct MshElement {
    std::size_t nodes = 0;
    std::size_t corners = 0;
    int dimension = 0;
};

std::optional<MshElement> msh_element(std::int64_t type) {
    static const std::map<std::int64_t, MshElement> known{
        {1, {2, 0, 1}},   {2, {3, 3, 2}},   {3, {4, 4, 2}},   {4, {4, 0, 3}},  {5, {8, 0, 3}},   {6, {6, 0, 3}},
        {7, {5, 0, 3}},   {8, {3, 0, 1}},   {9, {6, 3, 2}},   {10, {9, 4, 2}}, {11, {10, 0, 3}}, {12, {27, 0, 3}},
        {13, {18, 0, 3}}, {14, {14, 0, 3}}, {15, {1, 0, 0}},  {16, {8, 4, 2}}, {17, {20, 0, 3}}, {18, {15, 0, 3}},
        {19, {13, 0, 3}}, {20, {9, 3, 2}},  {21, {10, 3, 2}}, {26, {4, 0, 1}}, {27, {5, 0, 1}},  {29, {20, 0, 3}}};
    const auto found = known.find(type);
    return found == known.end() ? std::nullopt : std::optional(found->second);
}

struct MshFace {
    std::int64_t tag = 0;
    std::size_t count = 0;  // of corners
    std::array<std::int64_t, 4> corners{};
    std::vector<std::uint32_t> groups{};
    Place place{};
};

/// Reads the faces of a Gmsh mesh file, 2.2 or 4.1, text or bytes. Regions are physical surfaces.
class MshFile {
public:
    MshFile(std::span<const std::byte> bytes, std::uint32_t max_faces) : in_(bytes), builder_(max_faces) {}

    Expected<TriangleMesh> read() {
        while (in_.ok() && in_.more()) read_section();
        if (in_.ok() && version_ == 0) in_.fail(Cause::kMalformedInput, "expected '$MeshFormat', which the file does not have");
        if (!in_.ok()) return in_.error();
        Expected<TriangleMesh> mesh = builder_.take();
        if (mesh) groups_.apply(*mesh);
        return mesh;
    }

private:
    [[nodiscard]] bool is_4() const { return version_ > 4; }
    /// The type of counts and tags in 4.1; 2.2 has integers.
    [[nodiscard]] Kind size_kind() const { return is_4() ? size_kind_ : Kind::kInt32; }

    void read_section() {
        as_text_lines();
        const std::string_view name = in_.word();
        if (name == "$MeshFormat") return read_format();
        if (!name.starts_with('$')) return in_.fail(Cause::kMalformedInput, "expected the name of a section, " + found(name));
        const std::string end = "$End" + std::string(name.substr(1));
        // 2.2 knows entities as well, of another form, and says the groups of each element beside it.
        const bool entities = is_4() && (name == "$Entities" || name == "$PartitionedEntities");
        const bool known = name == "$PhysicalNames" || entities || name == "$Nodes" || name == "$Elements";
        if (known && version_ == 0) return in_.fail(Cause::kMalformedInput, "'$MeshFormat' must come first, " + found(name));
        if (name == "$PhysicalNames") read_physical_names();
        if (entities) with_numbers([&] { read_entities(name == "$PartitionedEntities"); });
        if (name == "$Nodes") is_4() ? with_numbers([&] { read_nodes_4(); }) : read_nodes_2();
        if (name == "$Elements") is_4() ? with_numbers([&] { read_elements_4(); }) : read_elements_2();
        if (!in_.ok()) return;
        as_text_lines();
        if (known) return in_.expect(end);
        in_.skip_past_line(end);
    }

    void as_text_lines() { in_.set_text(); }

    template <class Read>
    void with_numbers(Read read) {
        if (binary_) {
            in_.end_line();
            in_.set_binary(order_);
        }
        read();
    }

    void read_format() {
        version_ = in_.number(Kind::kFloat64, "a version");
        binary_ = in_.count(Kind::kInt32, "0 for text or 1 for bytes", 1) == 1;
        const std::uint64_t size = in_.count(Kind::kInt32, "the size of a number", 8);
        if (!in_.ok()) return;
        if (version_ != 2.2 && version_ != 2.1 && version_ != 2 && version_ != 4.1) {
            return in_.fail(Cause::kUnsupported, "version " + to_text(version_) + " is not read; 2.2 and 4.1 are");
        }
        if (size != 8 && size != 4) return in_.fail(Cause::kMalformedInput, "expected a size of 8 or 4");
        size_kind_ = size == 8 ? Kind::kUint64 : Kind::kUint32;
        if (binary_) {
            in_.end_line();
            in_.set_binary(std::endian::little);
            const std::int64_t one = in_.integer(Kind::kInt32, "the number 1");
            if (one != 1 && one != 0x01000000) in_.fail(Cause::kMalformedInput, "expected the number 1 as bytes");
            order_ = one == 1 ? std::endian::little : std::endian::big;
            in_.set_text();
        }
        in_.expect("$EndMeshFormat");
    }

    void read_physical_names() {
        const std::uint64_t count = in_.count(Kind::kInt32, "the number of names", kMost);
        for (std::uint64_t i = 0; i < count && in_.ok(); ++i) {
            const std::int64_t dimension = in_.integer(Kind::kInt32, "a dimension");
            const std::uint64_t tag = in_.count(Kind::kInt32, "a physical tag", kMost);
            std::string_view name = trimmed(in_.line());
            if (name.size() < 2 || name.front() != '"' || name.back() != '"')
                return in_.fail(Cause::kMalformedInput, "expected a name in quotes, " + found(name));
            if (dimension == 2) groups_.name(static_cast<std::uint32_t>(tag), std::string(name.substr(1, name.size() - 2)));
        }
    }

    /// Those of partitions say in front which they are, and which entity they are a part of.
    void read_entities(bool partitioned) {
        if (partitioned) {
            static_cast<void>(in_.count(size_kind_, "a number of partitions", kMost));
            const std::uint64_t ghosts = in_.count(size_kind_, "a number of ghost entities", kMost);
            for (std::uint64_t i = 0; i < 2 * ghosts && in_.ok(); ++i)
                static_cast<void>(in_.integer(Kind::kInt32, "a ghost entity"));
        }
        has_entities_ = true;
        std::array<std::uint64_t, 4> counts{};
        for (std::uint64_t& count : counts) count = in_.count(size_kind_, "a number of entities", kMost);
        for (std::size_t dimension = 0; dimension < 4; ++dimension) {
            for (std::uint64_t i = 0; i < counts[dimension] && in_.ok(); ++i) read_entity(dimension, partitioned);
        }
    }

    void read_entity(std::size_t dimension, bool partitioned) {
        const std::int64_t tag = in_.integer(Kind::kInt32, "an entity's tag");
        if (partitioned) {
            static_cast<void>(in_.integer(Kind::kInt32, "a parent's dimension"));
            static_cast<void>(in_.integer(Kind::kInt32, "a parent's tag"));
            const std::uint64_t parts = in_.count(size_kind_, "a number of partitions", kMost);
            for (std::uint64_t i = 0; i < parts && in_.ok(); ++i) static_cast<void>(in_.integer(Kind::kInt32, "a partition"));
        }
        for (int i = 0; i < (dimension == 0 ? 3 : 6); ++i) static_cast<void>(in_.number(Kind::kFloat64, "a bound of an entity"));
        const std::uint64_t physical = in_.count(size_kind_, "a number of physical tags", kMost);
        std::vector<std::uint32_t> groups;
        for (std::uint64_t i = 0; i < physical && in_.ok(); ++i) groups.push_back(read_group());
        if (dimension == 2) combination_of_[tag] = groups_.combination(groups);
        if (dimension == 0) return;
        const std::uint64_t bounding = in_.count(size_kind_, "a number of bounding entities", kMost);
        for (std::uint64_t i = 0; i < bounding && in_.ok(); ++i) static_cast<void>(in_.integer(Kind::kInt32, "an entity's tag"));
    }

    /// Its sign says how the surface is turned.
    std::uint32_t read_group() { return static_cast<std::uint32_t>(std::abs(in_.integer(Kind::kInt32, "a physical tag"))); }

    Vec3 read_point() {
        Vec3 point;
        for (int axis = 0; axis < 3; ++axis) point[axis] = in_.number(Kind::kFloat64, "a coordinate");
        return point;
    }

    void add_node(std::int64_t tag, const Vec3& point) {
        if (in_.ok()) in_.keep(builder_.add_node(tag, point, in_.place()));
    }

    void read_nodes_4() {
        const auto [blocks, announced] = read_counts();
        std::uint64_t read = 0;
        std::vector<std::int64_t> tags;
        for (std::uint64_t block = 0; block < blocks && in_.ok(); ++block) {
            const std::int64_t dimension = in_.integer(Kind::kInt32, "an entity's dimension");
            static_cast<void>(in_.integer(Kind::kInt32, "an entity's tag"));
            const bool parametric = in_.count(Kind::kInt32, "whether nodes are parametric", 1) == 1;
            const std::uint64_t count = in_.count(size_kind_, "a number of nodes", in_.left());
            read += count;
            tags.clear();
            for (std::uint64_t i = 0; i < count && in_.ok(); ++i)
                tags.push_back(static_cast<std::int64_t>(in_.count(size_kind_, "a node's tag", kMost)));
            for (std::uint64_t i = 0; i < count && in_.ok(); ++i) {
                add_node(tags[i], read_point());
                for (std::int64_t u = 0; parametric && u < dimension && in_.ok(); ++u)
                    static_cast<void>(in_.number(Kind::kFloat64, "a parameter of a node"));
            }
        }
        check_total(read, announced, "nodes");
    }

    struct Counts {
        std::uint64_t blocks = 0;
        std::uint64_t all = 0;
    };

    /// Blocks, then all they hold, then the least and largest tag.
    Counts read_counts() {
        Counts counts;
        counts.blocks = in_.count(size_kind_, "a number of blocks", kMost);
        counts.all = in_.count(size_kind_, "a total of the blocks", kMost);
        for (int i = 0; i < 2; ++i) static_cast<void>(in_.count(size_kind_, "a least or largest tag", kMost));
        return counts;
    }

    void check_total(std::uint64_t read, std::uint64_t announced, const char* what) {
        if (!in_.ok() || read == announced) return;
        in_.fail(Cause::kMalformedInput,
                 std::to_string(announced) + " " + what + " are announced, and the blocks have " + std::to_string(read));
    }

    void read_elements_4() {
        const auto [blocks, announced] = read_counts();
        std::uint64_t read = 0;
        for (std::uint64_t block = 0; block < blocks && in_.ok(); ++block) {
            static_cast<void>(in_.integer(Kind::kInt32, "an entity's dimension"));
            const std::int64_t entity = in_.integer(Kind::kInt32, "an entity's tag");
            const Place entity_place = in_.place();
            const std::optional<MshElement> type = read_type();
            const std::uint64_t count = in_.count(size_kind_, "a number of elements", in_.left());
            read += count;
            const auto combination = combination_of_.find(entity);
            const bool known = combination != combination_of_.end();
            if (!known && has_entities_ && in_.ok() && type->corners > 0) {
                return in_.fail_at(entity_place, Cause::kIndexOutOfRange,
                                   "elements are on surface " + std::to_string(entity) + ", which $Entities does not define");
            }
            const std::uint32_t region = known ? combination->second : 0;
            for (std::uint64_t i = 0; i < count && in_.ok(); ++i) {
                const std::uint64_t tag = in_.count(size_kind_, "an element's tag", kMost);
                const MshFace face = read_element(static_cast<std::int64_t>(tag), *type, size_kind_);
                if (in_.ok() && type->corners > 0) add_face(face, region);
            }
        }
        check_total(read, announced, "elements");
    }

    std::optional<MshElement> read_type() {
        const std::int64_t number = in_.integer(Kind::kInt32, "an element's type");
        const std::optional<MshElement> type = msh_element(number);
        if (!type) in_.fail(Cause::kUnsupported, "elements of type " + std::to_string(number) + " are not read");
        return type;
    }

    MshFace read_element(std::int64_t tag, const MshElement& type, Kind kind) {
        MshFace face{tag, type.corners, {}, {}, in_.place()};
        for (std::size_t i = 0; i < type.nodes; ++i) {
            const std::uint64_t node = in_.count(kind, "a node of an element", kMost);
            if (i < type.corners) face.corners[i] = static_cast<std::int64_t>(node);
        }
        if (in_.ok() && type.dimension == 3) builder_.skip_solid();
        return face;
    }

    void add_face(const MshFace& face, std::uint32_t region) {
        in_.keep(builder_.add_element(face.tag, std::span(face.corners).first(face.count), face.place, region));
    }

    /// The count is text always; what follows may be bytes.
    void read_nodes_2() {
        const std::uint64_t count = in_.count(Kind::kInt32, "the number of nodes", in_.left());
        with_numbers([&] {
            for (std::uint64_t i = 0; i < count && in_.ok(); ++i) {
                const std::int64_t tag = in_.integer(Kind::kInt32, "a node's number");
                add_node(tag, read_point());
            }
        });
    }

    void read_elements_2() {
        const std::uint64_t count = in_.count(Kind::kInt32, "the number of elements", in_.left());
        with_numbers([&] {
            for (std::uint64_t done = 0; done < count && in_.ok();) {
                std::int64_t tag = in_.is_binary() ? 0 : in_.integer(Kind::kInt32, "an element's number");
                const std::optional<MshElement> type = read_type();
                const std::uint64_t block = in_.is_binary() ? in_.count(Kind::kInt32, "a number of elements", count - done) : 1;
                const std::uint64_t tags = in_.count(Kind::kInt32, "a number of tags", kMost);
                if (block == 0 && in_.ok()) return in_.fail(Cause::kMalformedInput, "a block has no elements");
                for (std::uint64_t i = 0; i < block && in_.ok(); ++i, ++done) {
                    if (in_.is_binary()) tag = in_.integer(Kind::kInt32, "an element's number");
                    std::vector<std::uint32_t> groups = read_tags(tags);
                    MshFace face = read_element(tag, *type, Kind::kInt32);
                    face.groups = std::move(groups);
                    if (in_.ok() && type->corners > 0) take_face(std::move(face));
                }
            }
            take_face({});
        });
    }

    /// The first tag is the physical one; 0 is none.
    std::vector<std::uint32_t> read_tags(std::uint64_t count) {
        std::vector<std::uint32_t> groups;
        for (std::uint64_t i = 0; i < count && in_.ok(); ++i) {
            const std::uint32_t tag = read_group();
            if (i == 0 && tag != 0) groups.push_back(tag);
        }
        return groups;
    }

    /// Gmsh writes an element of several groups once for each, one after the other: it is one face in all of them. The one before
    /// is added once another comes.
    void take_face(MshFace face) {
        MshFace& last = last_face_;
        const bool again = face.count == last.count && face.corners == last.corners && face.groups.size() == 1 &&
                           !last.groups.empty() &&
                           std::find(last.groups.begin(), last.groups.end(), face.groups[0]) == last.groups.end();
        if (again) return last.groups.push_back(face.groups[0]);
        if (last.count > 0 && in_.ok()) add_face(last, groups_.combination(last.groups));
        last = std::move(face);
    }

    static constexpr std::uint64_t kMost = 0xFFFFFFFE;

    NumberStream in_;
    ElementBuilder builder_;
    double version_ = 0;
    bool binary_ = false;
    std::endian order_ = std::endian::little;
    Kind size_kind_ = Kind::kUint64;
    PhysicalGroups groups_;
    bool has_entities_ = false;
    std::map<std::int64_t, std::uint32_t> combination_of_;  // of groups, by the surface
    MshFace last_face_;                                     // of 2.2
};

}  // namespace

Expected<TriangleMesh> read_msh(std::span<const std::byte> bytes, std::uint32_t max_faces) {
    return MshFile(bytes, max_faces).read();
}

}  // namespace vsplit

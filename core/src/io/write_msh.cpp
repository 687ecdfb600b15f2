#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "io/elements.h"
#include "io/named_regions.h"
#include "io/number_writer.h"
#include "io/writers.h"

namespace vsplit {
namespace {

// Of three nodes and of six.
constexpr std::int32_t kTriangle = 2;
constexpr std::int32_t kTriangle6 = 9;

/// Writes the file section by section; regions are physical surfaces.
class MshWriter {
public:
    MshWriter(const Elements& elements, bool text)
        : elements_(elements),
          mesh_(elements.mesh()),
          regions_(named_regions(mesh_)),
          text_(text),
          out_(text ? NumberWriter::As::kText : NumberWriter::As::kLittleEndian) {}

    std::string write_4() {
        write_format("4.1");
        write_names(true);
        write_entities();
        write_nodes_4();
        write_elements_4();
        return out_.take();
    }

    std::string write_2() {
        write_format("2.2");
        write_names(false);
        write_nodes_2();
        write_elements_2();
        return out_.take();
    }

private:
    /// After numbers as bytes a line ends too.
    void end_section(std::string_view name) { out_ << (text_ ? "" : "\n") << name << "\n"; }

    void write_format(std::string_view version) {
        out_ << "$MeshFormat\n" << version << (text_ ? " 0 8\n" : " 1 8\n");
        if (!text_) out_.put(std::int32_t{1});
        end_section("$EndMeshFormat");
    }

    static std::string name_line(std::uint64_t tag, std::string name) {
        std::replace(name.begin(), name.end(), '"', '\'');
        return "2 " + std::to_string(tag) + " \"" + name + "\"\n";
    }

    /// Names of regions; with_sets: and of sets that are no region's name, with tags that no region has.
    void write_names(bool with_sets) {
        std::vector<std::string> lines;
        std::set<std::string_view> names;
        for (const NamedRegion& region : regions_) {
            if (region.region != 0 && region.has_name) lines.push_back(name_line(region.region, region.name));
            if (region.has_name) names.insert(region.name);
        }
        std::uint64_t sets = 0;
        for (const FaceSet& set : sets_with_faces(mesh_)) {
            if (!with_sets || names.count(set.name) != 0) continue;
            const std::uint64_t tag = std::uint64_t{regions_.back().region} + 1 + sets++;
            for (const std::uint32_t region : std::set(set.regions.begin(), set.regions.end()))
                set_tags_[region].push_back(static_cast<std::int32_t>(tag));
            lines.push_back(name_line(tag, set.name));
        }
        if (lines.empty()) return;
        out_ << "$PhysicalNames\n" << std::to_string(lines.size()) << "\n";
        for (const std::string& line : lines) out_ << line;
        out_ << "$EndPhysicalNames\n";
    }

    /// The physical groups of a region: its own, then the sets it is in.
    [[nodiscard]] std::vector<std::int32_t> groups_of(std::uint32_t region) const {
        std::vector<std::int32_t> groups;
        if (region != 0) groups.push_back(static_cast<std::int32_t>(region));
        if (const auto tags = set_tags_.find(region); tags != set_tags_.end())
            groups.insert(groups.end(), tags->second.begin(), tags->second.end());
        return groups;
    }

    /// A surface a region, with its physical tags; no curves around them.
    void write_entities() {
        out_ << "$Entities\n";
        for (const std::size_t count : {std::size_t{0}, std::size_t{0}, regions_.size(), std::size_t{0}})
            out_.put(std::uint64_t{count});
        out_.end_row();
        for (std::size_t i = 0; i < regions_.size(); ++i) write_entity(static_cast<std::int32_t>(i + 1), regions_[i]);
        end_section("$EndEntities");
    }

    void write_entity(std::int32_t tag, const NamedRegion& region) {
        BoundingBox box;
        for (const std::uint32_t f : region.faces) {
            for (const std::uint32_t v : mesh_.faces[f]) {
                box.min = box.min.cwiseMin(mesh_.positions[v]);
                box.max = box.max.cwiseMax(mesh_.positions[v]);
            }
        }
        out_.put(tag);
        out_.put(box.min);
        out_.put(box.max);
        const std::vector<std::int32_t> groups = groups_of(region.region);
        out_.put(std::uint64_t{groups.size()});
        for (const std::int32_t group : groups) out_.put(group);
        out_.put(std::uint64_t{0});
        out_.end_row();
    }

    [[nodiscard]] std::int32_t type() const { return elements_.order_nodes() == 3 ? kTriangle : kTriangle6; }

    void put_counts(std::uint64_t blocks, std::uint64_t count) {
        for (const std::uint64_t n : {blocks, count, std::uint64_t{1}, count}) out_.put(n);
        out_.end_row();
    }

    void write_nodes_4() {
        const std::uint64_t count = elements_.node_count();
        out_ << "$Nodes\n";
        put_counts(1, count);
        for (const std::int32_t n : {2, 1, 0}) out_.put(n);  // on the first surface, not parametric
        out_.put(count);
        out_.end_row();
        for (std::uint64_t tag = 1; tag <= count; ++tag) {
            out_.put(tag);
            out_.end_row();
        }
        for (std::uint64_t node = 0; node < count; ++node) {
            out_.put(elements_.position(node));
            out_.end_row();
        }
        end_section("$EndNodes");
    }

    void write_elements_4() {
        out_ << "$Elements\n";
        put_counts(regions_.size(), mesh_.faces.size());
        for (std::size_t i = 0; i < regions_.size(); ++i) {
            for (const std::int32_t n : {std::int32_t{2}, static_cast<std::int32_t>(i + 1), type()}) out_.put(n);
            out_.put(std::uint64_t{regions_[i].faces.size()});
            out_.end_row();
            for (const std::uint32_t f : regions_[i].faces) {
                out_.put(std::uint64_t{f} + 1);
                for (std::uint32_t n = 0; n < elements_.order_nodes(); ++n) out_.put(std::uint64_t{elements_.node(f, n)} + 1);
                out_.end_row();
            }
        }
        end_section("$EndElements");
    }

    void write_nodes_2() {
        out_ << "$Nodes\n" << std::to_string(elements_.node_count()) << "\n";
        for (std::size_t v = 0; v < elements_.node_count(); ++v) {
            out_.put(static_cast<std::int32_t>(v + 1));
            out_.put(elements_.position(v));
            out_.end_row();
        }
        end_section("$EndNodes");
    }

    void write_elements_2() {
        out_ << "$Elements\n" << std::to_string(mesh_.faces.size()) << "\n";
        if (!text_ && !mesh_.faces.empty()) {
            for (const std::int32_t n : {type(), static_cast<std::int32_t>(mesh_.faces.size()), 2}) out_.put(n);
        }
        for (std::size_t f = 0; f < mesh_.faces.size(); ++f) write_element_2(f);
        end_section("$EndElements");
    }

    void write_element_2(std::size_t f) {
        const auto region = static_cast<std::int32_t>(mesh_.regions.empty() ? 0 : mesh_.regions[f]);
        out_.put(static_cast<std::int32_t>(f + 1));
        if (text_) {
            for (const std::int32_t n : {type(), 2}) out_.put(n);
        }
        for (const std::int32_t n : {region, std::max(region, 1)}) out_.put(n);  // the geometric tag must not be 0
        for (std::uint32_t i = 0; i < elements_.order_nodes(); ++i) out_.put(static_cast<std::int32_t>(elements_.node(f, i) + 1));
        out_.end_row();
    }

    const Elements& elements_;
    const TriangleMesh& mesh_;
    std::vector<NamedRegion> regions_;
    std::map<std::uint32_t, std::vector<std::int32_t>> set_tags_;  // by region: of the sets of several regions that it is in
    bool text_;
    NumberWriter out_;
};

}  // namespace

std::string write_msh_4(const Elements& elements, bool text) { return MshWriter(elements, text).write_4(); }

std::string write_msh_2(const Elements& elements, bool text) { return MshWriter(elements, text).write_2(); }

}  // namespace vsplit

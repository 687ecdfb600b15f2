#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "io/element_builder.h"
#include "io/read_error.h"
#include "io/readers.h"
#include "io/text_lines.h"
#include "io/writers.h"

namespace vsplit {
namespace {

/// What is made of the lines under a keyword.
enum class Section { kSkipped, kNodes, kElements, kSet, kSurface };

struct ElementType {
    std::size_t nodes = 0;
    std::size_t corners = 0;  // 0: not a face
};

/// By what a type's name begins with: S3, S3R, S6, STRI3, STRI65, CPS3, CPE6, M3D3, SFM3D3, R3D3, S4, S4R, S8R, C3D4, ...
std::optional<ElementType> element_type(std::string_view name) {
    struct Known {
        std::string_view prefix;
        ElementType type;
    };
    static constexpr std::array<Known, 21> kKnown = {
        {{"STRI65", {6, 3}}, {"STRI3", {3, 3}},  {"SFM3D3", {3, 3}}, {"SFM3D6", {6, 3}}, {"M3D3", {3, 3}}, {"M3D6", {6, 3}},
         {"R3D3", {3, 3}},   {"R3D4", {4, 4}},   {"CPS3", {3, 3}},   {"CPS6", {6, 3}},   {"CPE3", {3, 3}}, {"CPE6", {6, 3}},
         {"C3D4", {4, 0}},   {"C3D10", {10, 0}}, {"C3D8", {8, 0}},   {"C3D20", {20, 0}}, {"C3D6", {6, 0}}, {"C3D15", {15, 0}},
         {"S3", {3, 3}},     {"S6", {6, 3}},     {"S4", {4, 4}}}};
    for (const Known& known : kKnown) {
        if (name.starts_with(known.prefix)) return known.type;
    }
    if (name.starts_with("S8")) return ElementType{8, 4};
    return {};
}

/// Reads the surface of an Abaqus or CalculiX input deck: *NODE, *ELEMENT, *ELSET, *SURFACE of elements. What else there is
/// (materials, steps, node sets) says nothing about the mesh and is passed over.
class InpText {
public:
    InpText(std::string_view text, std::uint32_t max_faces) : lines_(text), builder_(max_faces) {}

    Expected<TriangleMesh> read() {
        while (lines_.next()) {
            std::string_view line = trimmed(lines_.line());
            if (line.empty() || line.starts_with("**")) continue;
            const Status status = line.starts_with('*') ? read_keyword(line) : read_data(line);
            if (!status) return status.error();
        }
        if (Status whole = end_element(); !whole) return whole.error();
        return builder_.take();
    }

private:
    Status read_keyword(std::string_view line) {
        if (Status whole = end_element(); !whole) return whole;
        const std::string keyword = upper_case(next_field(line, ','));
        read_parameters(line);
        section_ = Section::kSkipped;
        if (keyword == "*NODE") section_ = Section::kNodes;
        if (keyword == "*ELEMENT") return begin_elements();
        if (keyword == "*ELSET") return begin_set("ELSET", Section::kSet);
        if (keyword == "*SURFACE" && (type_.empty() || type_ == "ELEMENT")) return begin_set("NAME", Section::kSurface);
        if (keyword == "*INCLUDE") return unsupported("*INCLUDE is not followed; put the mesh into one file");
        if (keyword == "*SYSTEM") return unsupported("*SYSTEM is not read; give nodes in the global system");
        if (keyword == "*PART" && std::exchange(has_part_, true))
            return unsupported("a second *PART is not read; write each part, or the mesh without parts, into a file");
        return Done{};
    }

    void read_parameters(std::string_view rest) {
        type_.clear();
        elset_.clear();
        name_.clear();
        generate_ = false;
        while (!trimmed(rest).empty()) {
            std::string_view parameter = next_field(rest, ',');
            const std::string key = upper_case(next_field(parameter, '='));
            std::string_view value = trimmed(parameter);
            if (value.size() > 1 && value.front() == '"' && value.back() == '"') value = value.substr(1, value.size() - 2);
            if (key == "TYPE") type_ = upper_case(value);
            if (key == "ELSET") elset_ = value;
            if (key == "NAME") name_ = value;
            if (key == "GENERATE") generate_ = true;
        }
    }

    Status begin_elements() {
        if (type_.empty()) return malformed("*ELEMENT needs a TYPE");
        element_ = element_type(type_);
        section_ = element_ ? Section::kElements : Section::kSkipped;
        return Done{};
    }

    Status begin_set(const char* parameter, Section section) {
        set_ = section == Section::kSet ? elset_ : name_;
        section_ = section;
        if (!set_.empty()) return Done{};
        return malformed("a set needs a name: " + std::string(parameter) + "=...");
    }

    Status read_data(std::string_view line) {
        switch (section_) {
            case Section::kSkipped:
                break;
            case Section::kNodes:
                return read_node(line);
            case Section::kElements:
                return read_element(line);
            case Section::kSet:
                return generate_ ? read_generated(line) : read_members(line);
            case Section::kSurface:
                return read_side(next_field(line, ','));  // which side, or which edges, says nothing about the face
        }
        return Done{};
    }

    Status read_node(std::string_view line) {
        const Expected<std::int64_t> id = read_integer(next_field(line, ','), "a node's number");
        if (!id) return id.error();
        Vec3 position = Vec3::Zero();
        for (int axis = 0; axis < 3; ++axis) {
            const std::string_view field = next_field(line, ',');
            if (field.empty() && axis > 0) continue;  // left out: 0
            const std::optional<double> value = parse_number(field);
            if (!value) return malformed("expected a coordinate, " + found(field));
            position[axis] = *value;
        }
        return builder_.add_node(*id, position, place());
    }

    /// An element goes on over lines until it has its nodes.
    Status read_element(std::string_view line) {
        if (numbers_.empty()) element_line_ = lines_.number();
        while (!trimmed(line).empty()) {
            const Expected<std::int64_t> number = read_integer(next_field(line, ','), "a node's number");
            if (!number) return number.error();
            numbers_.push_back(*number);
        }
        if (numbers_.size() <= element_->nodes) return Done{};
        if (numbers_.size() > element_->nodes + 1) {
            return malformed("element " + std::to_string(numbers_[0]) + " of type " + quoted(type_) + " has " +
                             std::to_string(numbers_.size() - 1) + " nodes; expected " + std::to_string(element_->nodes));
        }
        const std::int64_t id = numbers_[0];
        const std::vector<std::int64_t> nodes(numbers_.begin() + 1, numbers_.end());
        numbers_.clear();
        if (element_->corners == 0) {
            builder_.skip_solid();
            return Done{};
        }
        if (!elset_.empty() && !equals_ignoring_case(elset_, kAllElements)) builder_.add_to_set(elset_, id, id, 1, place());
        return builder_.add_element(id, std::span(nodes).first(element_->corners), at_line(element_line_));
    }

    Status end_element() {
        if (numbers_.empty()) return Done{};
        return read_error(Cause::kMalformedInput, at_line(element_line_),
                          "element " + std::to_string(numbers_[0]) + " of type " + quoted(type_) + " ends after " +
                              std::to_string(numbers_.size() - 1) + " nodes; expected " + std::to_string(element_->nodes));
    }

    Status read_generated(std::string_view line) {
        const Expected<std::int64_t> first = read_integer(next_field(line, ','), "the first element");
        if (!first) return first.error();
        const Expected<std::int64_t> last = read_integer(next_field(line, ','), "the last element");
        if (!last) return last.error();
        std::int64_t step = 1;
        if (const std::string_view field = next_field(line, ','); !field.empty()) {
            const Expected<std::int64_t> given = read_integer(field, "the step");
            if (!given) return given.error();
            step = *given;
        }
        if (step < 1) return malformed("expected a step of 1 or more, found " + std::to_string(step));
        builder_.add_to_set(set_, *first, *last, step, place());
        return Done{};
    }

    Status read_members(std::string_view line) {
        while (!trimmed(line).empty()) {
            if (Status read = read_member(next_field(line, ',')); !read) return read;
        }
        return Done{};
    }

    /// A surface that is but a set of elements seen from a side, as we write them, is no other set.
    Status read_side(std::string_view field) {
        if (equals_ignoring_case(set_, std::string(field) + std::string(kSurfaceSuffix))) return Done{};
        return read_member(field);
    }

    Status read_member(std::string_view field) {
        if (field.empty()) return malformed("expected an element's number or the name of a set, found nothing");
        if (const std::optional<std::int64_t> id = parse_integer(field)) {
            builder_.add_to_set(set_, *id, *id, 1, place());
        } else {
            builder_.add_set_to_set(set_, std::string(field), place());
        }
        return Done{};
    }

    [[nodiscard]] Expected<std::int64_t> read_integer(std::string_view field, const char* what) const {
        const std::optional<std::int64_t> number = parse_integer(field);
        if (number && *number >= 0 && *number <= kLargestId) return *number;
        return malformed("expected " + std::string(what) + ", " + found(field)).error();
    }

    [[nodiscard]] Place place() const { return at_line(lines_.number()); }
    [[nodiscard]] Status malformed(const std::string& what) const { return read_error(Cause::kMalformedInput, place(), what); }
    [[nodiscard]] Status unsupported(const std::string& what) const { return read_error(Cause::kUnsupported, place(), what); }

    TextLines lines_;
    ElementBuilder builder_;
    Section section_ = Section::kSkipped;
    std::string type_;
    std::string elset_;
    std::string name_;
    std::string set_;
    bool generate_ = false;
    bool has_part_ = false;
    std::optional<ElementType> element_;
    std::vector<std::int64_t> numbers_;  // of an element that is not whole yet
    std::size_t element_line_ = 0;
};

}  // namespace

Expected<TriangleMesh> read_inp(std::span<const std::byte> bytes, std::uint32_t max_faces) {
    return InpText(without_mark(as_text(bytes)), max_faces).read();
}

}  // namespace vsplit

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "io/element_builder.h"
#include "io/inp_assembly.h"
#include "io/inp_elements.h"
#include "io/inp_keyword.h"
#include "io/read_error.h"
#include "io/readers.h"
#include "io/text_lines.h"
#include "io/writers.h"

namespace vsplit {
namespace {

/// What is made of the lines under a keyword.
enum class Section { kSkipped, kNodes, kElements, kOthers, kSet, kSurface, kUnion, kInstance };

/// Reads the surface of an Abaqus or CalculiX input deck: *NODE, *ELEMENT, *ELSET, *SURFACE of elements, each part as often as
/// it is placed. What else there is (materials, steps, node sets) says nothing about the mesh and is passed over.
class InpText {
public:
    InpText(std::string_view text, std::uint32_t max_faces)
        : lines_(text), builder_(max_faces), part_bytes_left_(kPartBytes + kPartBytesAFace * max_faces + text.size()) {}

    Expected<TriangleMesh> read() {
        Status done = read_lines({});
        if (done) done = place_instance();
        if (done) done = read_lonely_part();
        if (!done) return done.error();
        builder_.ignore_set_of_all(kAllElements);
        Expected<TriangleMesh> mesh = builder_.take();
        if (!mesh) {
            Error error = mesh.error();
            error.message = assembly_.in_words(error.message);
            return error;
        }
        if (mesh->faces.empty() && !passed_over_.empty()) {
            return read_error(Cause::kUnsupported, at_line(passed_over_line_),
                              "the file has elements of type " + quoted(passed_over_) +
                                  ", but no triangle or quadrilateral; a surface mesh is needed");
        }
        assembly_.shorten_names(mesh->sets);
        return mesh;
    }

private:
    // As much as 3MF may unpack: a small file is not to make much work.
    static constexpr std::uint64_t kPartBytes = 1 << 20;
    static constexpr std::uint64_t kPartBytesAFace = 256;
    static constexpr std::uint64_t kSetBytes = 256;
    static constexpr std::uint64_t kMemberBytes = 64;

    /// To the end, or to the keyword `last`.
    Status read_lines(std::string_view last) {
        while (lines_.next()) {
            const std::string_view line = trimmed(lines_.line());
            if (line.empty() || line.starts_with("**")) continue;
            if (!line.starts_with('*')) {
                if (Status read = read_data(line); !read) return read;
                continue;
            }
            if (Status whole = end_element(); !whole) return whole;
            if (Status placed = place_instance(); !placed) return placed;
            keyword_line_ = lines_.number();
            keyword_ = take_inp_keyword(lines_);
            if (keyword_.name == last) return Done{};
            if (Status read = read_keyword(); !read) return read;
        }
        return end_element();
    }

    Status read_keyword() {
        section_ = Section::kSkipped;
        const std::string& name = keyword_.name;
        if (Status known = check_inp_keyword(keyword_, at_line(keyword_line_)); !known) return known;
        if (name == "*NODE") return begin_nodes();
        if (name == "*ELEMENT") return begin_elements();
        if (name == "*ELSET") return begin_set("ELSET", Section::kSet);
        if (name == "*SURFACE") return begin_surface();
        if (name == "*PART") return take_part();
        if (name == "*INSTANCE") return begin_instance();
        if (name == "*ENDINSTANCE") scope_ = 0;
        return Done{};
    }

    Status begin_nodes() {
        const std::string system = upper_case(keyword_.value("SYSTEM"));
        section_ = Section::kNodes;
        if (system.empty() || system == "R") return Done{};
        return unsupported("*NODE, SYSTEM=" + system + " is not read; give nodes in rectangular coordinates");
    }

    Status begin_elements() {
        type_ = upper_case(keyword_.value("TYPE"));
        const std::string set = keyword_.value("ELSET");
        elset_ = set.empty() ? std::string() : assembly_.set_name(scope_, set);
        if (type_.empty()) return malformed("*ELEMENT needs a TYPE");
        const std::optional<InpElement> element = inp_element(type_);
        if (!element) {
            return unsupported(
                "elements of type " + quoted(type_) +
                " are not known, so they could be faces; read are shells, membranes, surface and plane elements of "
                "3, 4, 6, 8 or 9 nodes; passed over solids, beams, trusses, springs, masses, connectors");
        }
        element_ = *element;
        section_ = element_.nodes == 0 ? Section::kOthers : Section::kElements;
        if (Status few = charge_set(elset_.empty() ? 0 : kSetBytes); !few) return few;
        if (element_.is_face()) return Done{};
        if (passed_over_.empty()) passed_over_line_ = keyword_line_;
        if (passed_over_.empty()) passed_over_ = type_;
        // A set without a face is a set that others may name.
        if (!elset_.empty()) builder_.add_set(elset_);
        return Done{};
    }

    Status begin_set(const char* parameter, Section section) {
        set_ = keyword_.value(parameter);
        section_ = section;
        member_scope_ = scope_;
        if (set_.empty()) return malformed("a set needs a name: " + std::string(parameter) + "=...");
        if (Status few = charge_set(kSetBytes); !few) return few;
        const std::string instance = keyword_.value("INSTANCE");
        if (instance.empty()) return Done{};
        const std::optional<std::size_t> scope = assembly_.find_instance(instance);
        if (!scope)
            return malformed("set " + quoted(set_) + " is of instance " + quoted(instance) + ", which does not come before");
        member_scope_ = *scope;
        return Done{};
    }

    Status begin_surface() {
        const std::string type = upper_case(keyword_.value("TYPE"));
        const std::string combine = upper_case(keyword_.value("COMBINE"));
        if (!type.empty() && type != "ELEMENT") return Done{};
        if (!combine.empty() && combine != "UNION") return unsupported("*SURFACE, COMBINE=" + combine + " is not read; UNION is");
        return begin_set("NAME", combine.empty() ? Section::kSurface : Section::kUnion);
    }

    /// Passes over a part's lines: they are read where it is placed.
    Status take_part() {
        const std::string name = keyword_.value("NAME");
        if (name.empty()) return malformed("*PART needs a NAME");
        if (assembly_.find_part(name) != nullptr) return malformed("part " + quoted(name) + " is there a second time");
        InpAssembly::Part part{lines_, 0, keyword_line_};
        while (lines_.next()) {
            const std::string_view line = trimmed(lines_.line());
            if (!line.starts_with('*') || line.starts_with("**")) continue;
            part.bytes = part.lines.rest().size() - lines_.rest().size();
            const std::string keyword = take_inp_keyword(lines_).name;
            if (keyword == "*PART") return malformed("*PART within part " + quoted(name) + "; expected its *END PART first");
            if (keyword != "*ENDPART") continue;
            assembly_.add_part(name, part);
            return Done{};
        }
        return read_error(Cause::kTruncatedInput, place(), "the file ends before the *END PART of part " + quoted(name));
    }

    Status begin_instance() {
        const std::string name = keyword_.value("NAME");
        const std::string part = keyword_.value("PART");
        if (name.empty() || part.empty()) return malformed("*INSTANCE needs a NAME and a PART");
        part_ = assembly_.find_part(part);
        if (part_ == nullptr) return malformed("*INSTANCE is of part " + quoted(part) + ", which does not come before");
        if (assembly_.instances() >= kMostInstances)
            return read_error(Cause::kLimitExceeded, at_line(keyword_line_), "the file has over a million instances");
        const std::optional<std::size_t> scope = assembly_.add_instance(name);
        if (!scope) return malformed("instance " + quoted(name) + " is there a second time");
        scope_ = *scope;
        section_ = Section::kInstance;
        motion_.clear();
        return Done{};
    }

    Status read_motion(std::string_view line) {
        const std::size_t wanted = motion_.empty() ? 3 : 7;
        if (motion_.size() > 3) return malformed("expected no third line of an instance's position");
        for (std::size_t i = 0; i < wanted; ++i) {
            const Expected<double> value = read_coordinate(next_field(line, ','));
            if (!value) return value.error();
            motion_.push_back(*value);
        }
        if (!trimmed(line).empty())
            return malformed("expected " + std::to_string(wanted) + " numbers, found also " + quoted(line));
        const std::string_view words = assembly_.move(scope_, motion_);
        return words.empty() ? Status(Done{}) : malformed(std::string(words));
    }

    /// Takes from what instances may come to: their text, and about what their sets take.
    Status charge(std::uint64_t bytes, std::size_t line) {
        if (bytes > part_bytes_left_) {
            return read_error(Cause::kLimitExceeded, at_line(line),
                              "the instances of the file's parts come to more text and sets than its limit of faces allows");
        }
        part_bytes_left_ -= bytes;
        return Done{};
    }

    [[nodiscard]] Status charge_set(std::uint64_t bytes) { return scope_ == 0 ? Status(Done{}) : charge(bytes, keyword_line_); }

    /// Once the lines that say where have been read: reads the part that is to be there.
    Status place_instance() { return part_ == nullptr ? Status(Done{}) : read_part(*std::exchange(part_, nullptr)); }

    Status read_part(const InpAssembly::Part& part) {
        if (Status small = charge(part.bytes, part.line); !small) return small;
        const TextLines here = std::exchange(lines_, part.lines);
        section_ = Section::kSkipped;
        Status read = read_lines("*ENDPART");
        if (read) lines_ = here;
        section_ = Section::kSkipped;
        return read;
    }

    /// Of a file that is but a part.
    Status read_lonely_part() {
        if (assembly_.instances() > 0 || assembly_.parts().empty()) return Done{};
        if (assembly_.parts().size() == 1) return read_part(assembly_.parts().begin()->second);
        std::size_t line = 0;
        for (const auto& [name, part] : assembly_.parts()) line = std::max(line, part.line);
        return read_error(Cause::kUnsupported, at_line(line),
                          "the file has " + std::to_string(assembly_.parts().size()) +
                              " parts, and no *INSTANCE that says which of them are there");
    }

    Status read_data(std::string_view line) {
        switch (section_) {
            case Section::kSkipped:
                break;
            case Section::kNodes:
                return read_node(line);
            case Section::kElements:
                return read_element(line);
            case Section::kOthers:
                return pass_over(next_field(line, ','));
            case Section::kSet:
                return keyword_.has("GENERATE") ? read_generated(line) : read_members(line);
            case Section::kSurface:
                return read_side(next_field(line, ','));  // which side, or which edges, says nothing about the face
            case Section::kUnion:
                return read_members(line);
            case Section::kInstance:
                return read_motion(line);
        }
        return Done{};
    }

    Status read_node(std::string_view line) {
        const Expected<std::int64_t> id = read_integer(next_field(line, ','), "a node's number");
        if (!id) return id.error();
        if (trimmed(line).empty()) return malformed("expected a coordinate, " + found(line));
        Vec3 position;
        for (int axis = 0; axis < 3; ++axis) {
            const Expected<double> value = read_coordinate(next_field(line, ','));
            if (!value) return value.error();
            position[axis] = *value;
        }
        return builder_.add_node(assembly_.number(scope_, *id), assembly_.moved(scope_, position), place());
    }

    /// One that is left out is 0.
    [[nodiscard]] Expected<double> read_coordinate(std::string_view field) const {
        const std::optional<double> value = field.empty() ? 0.0 : parse_fortran_number(field);
        if (value) return *value;
        return malformed("expected a coordinate, " + found(field)).error();
    }

    /// An element goes on over lines until it has its nodes.
    Status read_element(std::string_view line) {
        if (numbers_.empty()) element_line_ = lines_.number();
        while (!trimmed(line).empty()) {
            const Expected<std::int64_t> number = read_integer(next_field(line, ','), "a node's number");
            if (!number) return number.error();
            numbers_.push_back(*number);
        }
        if (numbers_.size() <= element_.nodes) return Done{};
        if (numbers_.size() > element_.nodes + 1) {
            return malformed("element " + std::to_string(numbers_[0]) + " of type " + quoted(type_) + " has " +
                             std::to_string(numbers_.size() - 1) + " nodes; expected " + std::to_string(element_.nodes));
        }
        if (!element_.is_face()) {
            builder_.skip_element(assembly_.number(scope_, numbers_[0]));
            builder_.skip_solid();
            numbers_.clear();
            return Done{};
        }
        for (std::int64_t& number : numbers_) number = assembly_.number(scope_, number);
        const std::vector<std::int64_t> numbers = std::exchange(numbers_, {});
        if (!elset_.empty()) builder_.define_in_set(elset_, numbers[0], place());
        return builder_.add_element(numbers[0], std::span(numbers).subspan(1, element_.corners), at_line(element_line_));
    }

    /// Of elements that are passed over unread a line begins with a number: the element's, or where they go on over lines a
    /// node's, which then passes for an element's.
    Status pass_over(std::string_view field) {
        const std::optional<std::int64_t> id = parse_integer(field);
        if (id && *id >= 0 && *id < InpAssembly::kNumbers) builder_.skip_element(assembly_.number(scope_, *id));
        return Done{};
    }

    Status end_element() {
        if (numbers_.empty()) return Done{};
        return read_error(Cause::kMalformedInput, at_line(element_line_),
                          "element " + std::to_string(numbers_[0]) + " of type " + quoted(type_) + " ends after " +
                              std::to_string(numbers_.size() - 1) + " nodes; expected " + std::to_string(element_.nodes));
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
        if (*last < *first) {
            return malformed("expected a last element from the first, " + std::to_string(*first) + ", on, found " +
                             std::to_string(*last));
        }
        if (Status few = charge_set(kMemberBytes); !few) return few;
        builder_.add_range_to_set(assembly_.set_name(scope_, set_), assembly_.number(member_scope_, *first),
                                  assembly_.number(member_scope_, *last), step, place());
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
        if (Status few = charge_set(kMemberBytes); !few) return few;
        const auto [scope, name] = assembly_.resolve(member_scope_, field);
        const std::string set = assembly_.set_name(scope_, set_);
        if (!parse_integer(name)) {
            builder_.add_set_to_set(set, assembly_.set_name(scope, name), place());
            return Done{};
        }
        const Expected<std::int64_t> given = read_integer(name, "an element's number");
        if (!given) return given.error();
        const std::int64_t id = assembly_.number(scope, *given);
        builder_.add_to_set(set, id, place());
        return Done{};
    }

    [[nodiscard]] Expected<std::int64_t> read_integer(std::string_view field, const char* what) const {
        const std::optional<std::int64_t> number = parse_integer(field);
        if (number && *number >= 0 && *number < InpAssembly::kNumbers) return *number;
        return malformed("expected " + std::string(what) + ", " + found(field)).error();
    }

    [[nodiscard]] Place place() const { return at_line(lines_.number()); }
    [[nodiscard]] Status malformed(const std::string& what) const { return read_error(Cause::kMalformedInput, place(), what); }
    [[nodiscard]] Status unsupported(const std::string& what) const {
        return read_error(Cause::kUnsupported, at_line(keyword_line_), what);
    }

    static constexpr std::size_t kMostInstances = 1'000'000;

    TextLines lines_;
    ElementBuilder builder_;
    InpAssembly assembly_;
    std::size_t scope_ = 0;
    Section section_ = Section::kSkipped;
    InpKeyword keyword_;
    std::size_t keyword_line_ = 0;
    std::string type_;  // of elements
    std::string elset_;
    InpElement element_;
    std::vector<std::int64_t> numbers_;  // of an element that is not whole yet
    std::size_t element_line_ = 0;
    std::string passed_over_;  // the first type without faces
    std::size_t passed_over_line_ = 0;
    std::string set_;
    std::size_t member_scope_ = 0;
    const InpAssembly::Part* part_ = nullptr;  // to be placed once its instance's motion is read
    std::vector<double> motion_;
    std::uint64_t part_bytes_left_ = 0;
};

}  // namespace

Expected<TriangleMesh> read_inp(std::span<const std::byte> bytes, std::uint32_t max_faces) {
    return InpText(without_mark(as_text(bytes)), max_faces).read();
}

}  // namespace vsplit

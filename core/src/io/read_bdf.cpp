#include <algorithm>
#include <array>
#include <forward_list>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "io/bdf_cards.h"
#include "io/element_builder.h"
#include "io/read_error.h"
#include "io/readers.h"
#include "io/text_lines.h"

namespace vsplit {
namespace {

/// A card as Nastran has them, put together from its lines: small field (8 columns), large field (16, a star at the name), or
/// free field (commas), each way with continuations. Every line gives 8 fields, or 4 large ones.
struct Card {
    std::string name;
    std::vector<std::string_view> fields;
    std::size_t line = 0;
    std::forward_list<std::string> expanded;  // lines that had tabs, which fields point into
};

constexpr std::size_t kNameWidth = 8;
constexpr std::size_t kFieldColumns = 64;  // behind the name; what follows is the mark of a continuation

/// With tabs as the blanks up to the next column that is a multiple of 8.
std::string with_blanks(std::string_view line) {
    std::string text;
    for (const char c : line) {
        const bool tab = c == '\t';
        text.append(tab ? kNameWidth - text.size() % kNameWidth : 1, tab ? ' ' : c);
    }
    return text;
}

class BdfText {
public:
    BdfText(std::string_view text, std::uint32_t max_faces) : lines_(text), builder_(max_faces) {}

    Expected<TriangleMesh> read() {
        const std::size_t begin = line_of_begin();
        bool ended = false;
        while (lines_.next()) {
            std::string_view line = lines_.line();
            if (line.starts_with('$')) {
                read_comment(line);
                continue;
            }
            line = line.substr(0, line.find('$'));
            if (trimmed(line).empty() || lines_.number() <= begin) continue;
            if (upper_case(trimmed(line).substr(0, 7)) == "ENDDATA") {
                ended = true;
                break;
            }
            if (Status taken = take_line(line); !taken) return taken.error();
        }
        if (Status used = use_card(); !used) return used.error();
        // Parts that others include have neither.
        if (begin != 0 && !ended)
            return read_error(
                Cause::kTruncatedInput, at_line(lines_.number()),
                "the file ends without the ENDDATA that belongs to its BEGIN BULK of line " + std::to_string(begin));
        if (Status basic = check_default_system(); !basic) return basic.error();
        Expected<TriangleMesh> mesh = builder_.take();
        // One property, and that the first, says nothing: a file needs some.
        const auto is_one = [](std::uint32_t region) { return region == 1; };
        const auto is_unused = [](const FaceSet& set) { return set.regions.empty(); };
        if (mesh && std::all_of(mesh->sets.begin(), mesh->sets.end(), is_unused) &&
            std::all_of(mesh->regions.begin(), mesh->regions.end(), is_one))
            mesh->regions.clear();
        return mesh;
    }

private:
    /// HyperMesh and others name the components, whose numbers are those of properties, in comments.
    void read_comment(std::string_view line) {
        if (next_word(line) != "$HMNAME" || next_word(line) != "COMP") return;
        const std::size_t quote = line.find('"');
        if (quote == std::string_view::npos) return;
        const std::optional<std::int64_t> id = parse_integer(trimmed(line.substr(0, quote)));
        std::string_view name = line.substr(quote + 1);
        name = name.substr(0, name.find('"'));
        if (id && *id > 0 && *id <= 0xFFFFFFFF && !name.empty())
            builder_.name_region(std::string(name), static_cast<std::uint32_t>(*id));
    }

    /// Of BEGIN BULK: before it stand commands, not cards. 0 where there is none.
    std::size_t line_of_begin() const {
        for (TextLines ahead = lines_; ahead.next();) {
            std::string_view rest = ahead.line();
            if (equals_ignoring_case(next_word(rest), "BEGIN")) return ahead.number();
        }
        return 0;
    }

    Status take_line(std::string_view line) {
        const bool free = line.find(',') != std::string_view::npos;
        const bool tabs = !free && line.find('\t') != std::string_view::npos;
        std::string blanks = tabs ? with_blanks(line) : std::string();
        std::string_view rest = tabs ? std::string_view(blanks) : line;
        const std::string first(free ? next_field(rest, ',') : trimmed(rest.substr(0, kNameWidth)));
        const bool continues = first.empty() || first.front() == '+' || first.front() == '*';
        if (!continues) {
            if (Status used = use_card(); !used) return used;
            card_ = Card{upper_case(first.substr(0, first.find('*'))), {}, lines_.number(), {}};
        }
        if (!card_) return Done{};
        if (tabs) rest = card_->expanded.emplace_front(std::move(blanks));
        const std::size_t width = first.find('*') == std::string::npos ? 8 : 16;
        if (free) {
            take_free(rest, kFieldColumns / width);
        } else {
            take_columns(rest, width);
        }
        return Done{};
    }

    /// Fields that are left out at the end are blank; what follows the last is the mark of a continuation.
    void take_free(std::string_view rest, std::size_t fields) {
        for (std::size_t i = 0; i < fields; ++i) {
            const std::string_view field = next_field(rest, ',');
            const bool mark = rest.empty() && (field.starts_with('+') || field.starts_with('*')) && !parse_fortran_number(field);
            card_->fields.push_back(mark ? std::string_view() : field);
        }
    }

    void take_columns(std::string_view line, std::size_t width) {
        line.remove_prefix(std::min(kNameWidth, line.size()));
        for (std::size_t at = 0; at < kFieldColumns; at += width) {
            card_->fields.push_back(at < line.size() ? trimmed(line.substr(at, width)) : std::string_view());
        }
    }

    Status use_card() {
        if (!card_) return Done{};
        const Card card = *std::exchange(card_, std::nullopt);
        if (card.name == "GRID") return use_grid(card);
        if (card.name == "GRDSET") default_system_ = {std::string(field(card, 1)), card.line};
        if (card.name.starts_with("BEGIN"))
            return error(card, Cause::kUnsupported, "superelements and further models in a file are not read");
        if (card.name.starts_with("INCLUDE"))
            return error(card, Cause::kUnsupported, "INCLUDE is not followed; put the mesh into one file");
        const BdfCard kind = bdf_card(card.name);
        if (kind.kind == BdfCard::Kind::kFace) return use_face(card, kind);
        if (kind.kind == BdfCard::Kind::kSolid) builder_.skip_solid();
        if (kind.kind == BdfCard::Kind::kUnknown) {
            return error(card, Cause::kUnsupported,
                         "a card of this name is not known, so it could be a face; read are CTRIA, CQUAD, CSHEAR, CTRAX, CQUADX, "
                         "CPLSTN and CPLSTS; passed over solids, beams, rods, springs, masses");
        }
        return Done{};
    }

    /// A system that GRDSET gives to the points that name none.
    Status check_default_system() const {
        const auto& [system, line] = default_system_;
        if (system.empty() || !has_default_system_ || parse_integer(system) == 0) return Done{};
        return read_error(
            Cause::kUnsupported, at_line(line),
            "GRDSET: grid points are given in coordinate system " + quoted(system) + "; only the basic one (0) is read");
    }

    Status use_grid(const Card& card) {
        const Expected<std::int64_t> id = integer(card, 0, "a grid point's number");
        if (!id) return id.error();
        const std::string_view system = field(card, 1);
        has_default_system_ = has_default_system_ || system.empty();
        if (!system.empty() && parse_integer(system) != 0) {
            return error(card, Cause::kUnsupported,
                         "grid point " + std::to_string(*id) + " is given in coordinate system " + quoted(system) +
                             "; only the basic one (0) is read");
        }
        if (Status whole = check_reach(card, 4); !whole) return whole;
        Vec3 position;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const std::string_view text = field(card, 2 + axis);
            const std::optional<double> value = text.empty() ? 0.0 : parse_fortran_number(text);
            if (!value) return error(card, Cause::kMalformedInput, "expected a coordinate, " + found(text));
            position[static_cast<Eigen::Index>(axis)] = *value;
        }
        return builder_.add_node(*id, position, at_line(card.line));
    }

    Status use_face(const Card& card, BdfCard kind) {
        const Expected<std::int64_t> id = integer(card, 0, "an element's number");
        if (!id) return id.error();
        std::int64_t property = *id;  // the default
        if (!field(card, 1).empty()) {
            const Expected<std::int64_t> given = integer(card, 1, "a property's number");
            if (!given) return given.error();
            property = *given;
        }
        if (Status whole = check_reach(card, 2 + (kind.corners - 1) * kind.step); !whole) return whole;
        std::array<std::int64_t, 4> nodes{};
        for (std::size_t i = 0; i < kind.corners; ++i) {
            const Expected<std::int64_t> node = integer(card, 2 + i * kind.step, "a grid point's number");
            if (!node) return node.error();
            nodes[i] = *node;
        }
        return builder_.add_element(*id, std::span(nodes).first(kind.corners), at_line(card.line),
                                    static_cast<std::uint32_t>(property));
    }

    /// Its lines have a field of that number, blank or not.
    static Status check_reach(const Card& card, std::size_t number) {
        if (number < card.fields.size()) return Done{};
        return error(card, Cause::kTruncatedInput,
                     "field " + std::to_string(number + 2) + " is on a line more, which does not follow");
    }

    static std::string_view field(const Card& card, std::size_t number) {
        return number < card.fields.size() ? card.fields[number] : std::string_view();
    }

    static Expected<std::int64_t> integer(const Card& card, std::size_t number, const char* what) {
        constexpr std::int64_t kLargest = 0xFFFFFFFE;
        const std::string_view text = field(card, number);
        const std::optional<std::int64_t> value = parse_integer(text);
        if (value && *value > 0 && *value <= kLargest) return *value;
        return error(card, Cause::kMalformedInput,
                     "expected " + std::string(what) + " in field " + std::to_string(number + 2) + ", " + found(text))
            .error();
    }

    static Status error(const Card& card, Cause cause, const std::string& what) {
        return read_error(cause, at_line(card.line), card.name + ": " + what);
    }

    TextLines lines_;
    ElementBuilder builder_;
    std::optional<Card> card_;
    std::pair<std::string, std::size_t> default_system_;  // GRDSET's, and its line
    bool has_default_system_ = false;                     // a point names none
};

}  // namespace

Expected<TriangleMesh> read_bdf(std::span<const std::byte> bytes, std::uint32_t max_faces) {
    return BdfText(without_mark(as_text(bytes)), max_faces).read();
}

}  // namespace vsplit

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "io/element_builder.h"
#include "io/read_error.h"
#include "io/readers.h"
#include "io/text_lines.h"

namespace vsplit {
namespace {

/// A card as Nastran has them, put together from its lines: small field (8 columns), large field (16, a star at the name), or
/// free field (commas), each way with continuations.
struct Card {
    std::string name;
    std::vector<std::string_view> fields;
    std::size_t line = 0;
};

constexpr std::size_t kNameWidth = 8;

/// Numbers may leave the E out, and have D for it: "1.5-3", "2.D+4".
std::optional<double> parse_real(std::string_view field) {
    std::string text(field);
    for (char& c : text) c = c == 'd' || c == 'D' ? 'e' : c;
    const std::size_t sign = text.find_last_of("+-");
    if (sign != std::string::npos && sign > 0 && text[sign - 1] != 'e' && text[sign - 1] != 'E') text.insert(sign, "e");
    return parse_number(text);
}

class BdfText {
public:
    BdfText(std::string_view text, std::uint32_t max_faces) : lines_(text), builder_(max_faces) {}

    Expected<TriangleMesh> read() {
        while (lines_.next()) {
            std::string_view line = lines_.line();
            if (line.starts_with('$')) {
                read_comment(line);
                continue;
            }
            line = line.substr(0, line.find('$'));
            if (trimmed(line).empty()) continue;
            if (upper_case(line).starts_with("ENDDATA")) break;
            if (Status taken = take_line(line); !taken) return taken.error();
        }
        if (Status used = use_card(); !used) return used.error();
        Expected<TriangleMesh> mesh = builder_.take();
        // One property, and that the first, says nothing: a file needs some.
        const auto is_one = [](std::uint32_t region) { return region == 1; };
        if (mesh && mesh->sets.empty() && std::all_of(mesh->regions.begin(), mesh->regions.end(), is_one)) mesh->regions.clear();
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

    Status take_line(std::string_view line) {
        const bool free = line.find(',') != std::string_view::npos;
        std::string_view rest = line;
        const std::string_view first = free ? next_field(rest, ',') : trimmed(line.substr(0, kNameWidth));
        const bool continues = first.empty() || first.front() == '+' || first.front() == '*';
        if (!continues) {
            if (Status used = use_card(); !used) return used;
            card_ = Card{upper_case(first.substr(0, first.find('*'))), {}, lines_.number()};
        }
        if (!card_) return Done{};
        if (free) return take_free(rest);
        return take_columns(line, first.find('*') != std::string_view::npos ? 16 : 8);
    }

    Status take_free(std::string_view rest) {
        while (!rest.empty()) {
            const std::string_view field = next_field(rest, ',');
            const bool mark = !field.empty() && field.front() == '+' && rest.empty() && !parse_real(field);
            if (!mark) card_->fields.push_back(field);
        }
        return Done{};
    }

    Status take_columns(std::string_view line, std::size_t width) {
        constexpr std::size_t kFieldColumns = 64;
        line.remove_prefix(std::min(kNameWidth, line.size()));
        line = line.substr(0, kFieldColumns);  // what follows is the mark of a continuation
        for (std::size_t at = 0; at < kFieldColumns; at += width) {
            card_->fields.push_back(at < line.size() ? trimmed(line.substr(at, width)) : std::string_view());
        }
        return Done{};
    }

    Status use_card() {
        if (!card_) return Done{};
        const Card card = *std::exchange(card_, std::nullopt);
        if (card.name == "GRID") return use_grid(card);
        if (card.name == "CTRIA3" || card.name == "CTRIA6" || card.name == "CTRIAR") return use_face(card, 3);
        if (card.name == "CQUAD4" || card.name == "CQUAD8" || card.name == "CQUADR") return use_face(card, 4);
        if (card.name == "CTETRA" || card.name == "CHEXA" || card.name == "CPENTA" || card.name == "CPYRAM")
            builder_.skip_solid();
        if (card.name == "INCLUDE" || card.name.starts_with("INCLUDE"))
            return error(card, Cause::kUnsupported, "INCLUDE is not followed; put the mesh into one file");
        return Done{};
    }

    Status use_grid(const Card& card) {
        const Expected<std::int64_t> id = integer(card, 0, "a grid point's number");
        if (!id) return id.error();
        const std::string_view system = field(card, 1);
        if (!system.empty() && parse_integer(system) != 0) {
            return error(card, Cause::kUnsupported,
                         "grid point " + std::to_string(*id) + " is given in coordinate system " + quoted(system) +
                             "; only the basic one (0) is read");
        }
        Vec3 position;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const std::string_view text = field(card, 2 + axis);
            const std::optional<double> value = text.empty() ? 0.0 : parse_real(text);
            if (!value) return error(card, Cause::kMalformedInput, "expected a coordinate, " + found(text));
            position[static_cast<Eigen::Index>(axis)] = *value;
        }
        return builder_.add_node(*id, position, at_line(card.line));
    }

    Status use_face(const Card& card, std::size_t corners) {
        const Expected<std::int64_t> id = integer(card, 0, "an element's number");
        if (!id) return id.error();
        std::int64_t property = *id;  // the default
        if (!field(card, 1).empty()) {
            const Expected<std::int64_t> given = integer(card, 1, "a property's number");
            if (!given) return given.error();
            property = *given;
        }
        std::array<std::int64_t, 4> nodes{};
        for (std::size_t i = 0; i < corners; ++i) {
            const Expected<std::int64_t> node = integer(card, 2 + i, "a grid point's number");
            if (!node) return node.error();
            nodes[i] = *node;
        }
        return builder_.add_element(*id, std::span(nodes).first(corners), at_line(card.line),
                                    static_cast<std::uint32_t>(property));
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
};

}  // namespace

Expected<TriangleMesh> read_bdf(std::span<const std::byte> bytes, std::uint32_t max_faces) {
    return BdfText(without_mark(as_text(bytes)), max_faces).read();
}

}  // namespace vsplit

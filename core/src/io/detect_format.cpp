#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "base/byte_order.h"
#include "io/bdf_cards.h"
#include "io/obj_keyword.h"
#include "io/off_header.h"
#include "io/stl_layout.h"
#include "io/text_lines.h"
#include "vsplit/io/mesh_format.h"

namespace vsplit {
namespace {

using Bytes = std::span<const std::byte>;

constexpr std::size_t kWindow = 4096;
constexpr std::size_t kMostComments = 1 << 20;  // bytes of them that are passed over

/// More than damage leaves in a text. Numbers as bytes have a few in each dozen.
template <typename Strange>
bool has_many(std::string_view bytes, Strange is_strange) {
    constexpr std::size_t kOneIn = 256;
    return static_cast<std::size_t>(std::count_if(bytes.begin(), bytes.end(), is_strange)) > 1 + bytes.size() / kOneIn;
}

bool is_control(char c) {
    const auto code = static_cast<unsigned char>(c);
    return code < '\t' || (code > '\r' && code < ' ');
}

/// Whether the bytes could be ASCII or UTF-8: no control characters but white space, no byte that UTF-8 never has.
bool is_text(std::string_view bytes) {
    return !has_many(bytes, [](char c) {
        const auto code = static_cast<unsigned char>(c);
        return is_control(c) || code == 0xC0 || code == 0xC1 || code > 0xF4;
    });
}

/// Text of any encoding has no control characters.
bool has_controls(std::string_view bytes) { return has_many(bytes, is_control); }

/// From the first line on that is neither blank nor a comment of OBJ, OFF (#), input decks (**) or bulk data ($); nothing where
/// that is too far off.
std::string_view without_comments(std::string_view text) {
    const std::string_view seen = text.substr(0, kMostComments);
    TextLines lines(seen);
    while (lines.next()) {
        const std::string_view line = trimmed(lines.line());
        const bool comment = line.starts_with('#') || line.starts_with("**") || line.starts_with('$');
        if (!line.empty() && !comment) return text.substr(static_cast<std::size_t>(lines.line().data() - text.data()));
    }
    return {};
}

/// No other file has as many bytes as these four of its own say.
bool has_stl_length(Bytes bytes) {
    if (bytes.size() < kStlFacetsAt) return false;
    return kStlFacetsAt + std::uint64_t{load<std::uint32_t>(bytes.data() + kStlHeaderBytes)} * kStlFacetBytes == bytes.size();
}

bool begins_with_facet(Bytes bytes) {
    if (bytes.size() < kStlFacetsAt + kStlFacetBytes) return false;
    std::array<float, 12> numbers{};
    for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = load<float>(bytes.data() + kStlFacetsAt + i * sizeof(float));
    const double length = std::hypot(numbers[0], numbers[1], numbers[2]);
    constexpr double kNearlyOne = 1e-2;
    return (length == 0 || std::abs(length - 1) < kNearlyOne) &&
           std::all_of(numbers.begin(), numbers.end(), [](float number) { return std::isfinite(number); });
}

/// A binary STL of the wrong length: cut off, or with a wrong count. It has no mark of its own, so its header must be text
/// (often followed by zeros), or what stands behind the header a facet with a unit normal.
bool resembles_binary_stl(Bytes bytes) {
    if (bytes.size() < kStlFacetsAt) return false;
    std::string_view header = as_text(bytes.first(kStlHeaderBytes));
    header = header.substr(0, header.find_last_not_of('\0') + 1);
    return is_text(header) || begins_with_facet(bytes);
}

MeshFormat kind_of_ply(std::string_view text) {
    TextLines lines(text);
    while (lines.next()) {
        std::string_view rest = lines.line();
        if (next_word(rest) == "format") return next_word(rest) == "ascii" ? MeshFormat::kPlyAscii : MeshFormat::kPlyBinary;
    }
    return MeshFormat::kPlyAscii;  // the reader will say what is missing
}

/// By the line of the format: its version, and whether bytes follow.
MeshFormat kind_of_msh(std::string_view text) {
    std::string_view rest = text.substr(std::min(text.find("$MeshFormat"), text.size()));
    static_cast<void>(next_word(rest));
    const bool old = next_word(rest).starts_with('2');
    const bool is_ascii = next_word(rest) == "0";
    if (old) return is_ascii ? MeshFormat::kMsh2Ascii : MeshFormat::kMsh2;
    return is_ascii ? MeshFormat::kMshAscii : MeshFormat::kMsh;
}

MeshFormat kind_of_vtk(std::string_view text) {
    TextLines lines(text);
    for (int line = 0; line < 3 && lines.next(); ++line) {
    }
    return equals_ignoring_case(trimmed(lines.line()), "BINARY") ? MeshFormat::kVtk : MeshFormat::kVtkAscii;
}

/// A line that begins the bulk data, or a card of a point or an element with its number.
bool is_bulk_line(std::string_view line) {
    const std::string begin = upper_case(trimmed(line).substr(0, 16));
    if (!begin.starts_with('B') && !begin.starts_with('G') && !begin.starts_with('C')) return false;
    const std::size_t end = std::min(begin.find_first_of(" ,*\t="), begin.size());
    const std::string_view name = std::string_view(begin).substr(0, end);
    const std::string_view rest = trimmed(line).substr(end);
    const std::size_t next = std::min(rest.find_first_not_of(" ,*\t"), rest.size());
    if (name == "BEGIN") return equals_ignoring_case(rest.substr(next, 4), "BULK");
    const BdfCard::Kind kind = bdf_card(name).kind;
    const bool of_mesh = name == "GRID" || kind == BdfCard::Kind::kFace || kind == BdfCard::Kind::kSolid;
    return of_mesh && next > 0 && next < rest.size() && rest[next] >= '0' && rest[next] <= '9';
}

/// Bulk data may begin with any command or card; they have such a line soon.
bool is_bulk_data(std::string_view text) {
    constexpr std::array<std::string_view, 8> kBegins = {"BEGIN BULK", "ENDDATA", "NASTRAN ", "SOL ",
                                                         "CEND",       "MAT1",    "PSHELL",   "ID "};
    TextLines lines(text.substr(0, kMostComments));
    bool is_first = true;
    while (lines.next()) {
        const std::string_view line = trimmed(lines.line());
        const std::string begin = is_first ? upper_case(line.substr(0, 16)) : std::string();
        is_first = false;
        const auto begins = [&](std::string_view known) { return begin.starts_with(known); };
        if (std::any_of(kBegins.begin(), kBegins.end(), begins) || is_bulk_line(line)) return true;
    }
    return false;
}

/// Formats that begin with a mark of their own.
std::optional<MeshFormat> detect_by_mark(std::string_view text) {
    if (text.starts_with("PK\x03\x04")) return MeshFormat::k3mf;  // no other format that is read is a zip archive
    if (text.starts_with("ply\n") || text.starts_with("ply\r\n")) return kind_of_ply(text);
    text = without_mark(text);
    if (text.starts_with("# vtk DataFile")) return kind_of_vtk(text);
    std::string_view rest = text;
    const std::string_view word = next_word(rest);
    if (word == "$MeshFormat" || (word == "$Comments" && text.find("$MeshFormat") != std::string_view::npos))
        return kind_of_msh(text);
    const bool xml = word.starts_with("<?xml") || word.starts_with("<VTKFile") || word.starts_with("<!--");
    return xml && text.find("<VTKFile") != std::string_view::npos ? std::optional(MeshFormat::kVtu) : std::nullopt;
}

/// An OFF may leave its keyword out: it begins with two or three counts, and a line of three coordinates follows.
bool is_off_without_keyword(std::string_view text) {
    TextLines lines(text.substr(0, kMostComments));
    if (!lines.next_content('#')) return false;
    std::size_t counts = 0;
    for (std::string_view line = lines.line(), word = next_word(line); !word.empty(); word = next_word(line), ++counts) {
        if (word.find_first_not_of("0123456789") != std::string_view::npos) return false;
    }
    if (counts < 2 || counts > 3 || !lines.next_content('#')) return false;
    std::string_view line = lines.line();
    for (int axis = 0; axis < 3; ++axis) {
        if (!parse_number(next_word(line))) return false;
    }
    return true;
}

/// By the first word that is no comment.
std::optional<MeshFormat> detect_by_word(std::string_view text, bool has_bytes) {
    const std::string_view content = without_comments(text);
    if (content.empty()) {  // comments as far as one looks
        const std::string_view comment = trimmed(text.substr(0, kWindow));
        if (comment.starts_with('#')) return MeshFormat::kObj;
        if (comment.starts_with("**")) return MeshFormat::kInp;
        return comment.starts_with('$') ? std::optional(MeshFormat::kBdf) : std::nullopt;
    }
    std::string_view line = content.substr(0, std::min(content.find_first_of("#\r\n"), content.size()));
    const std::string_view word = next_word(line);
    if (is_off_keyword(word)) return MeshFormat::kOff;
    if (has_bytes) return {};  // the header of a binary STL may begin with any word
    if (equals_ignoring_case(word, "solid")) return MeshFormat::kStlAscii;
    if (obj_line(word)) return MeshFormat::kObj;
    if (word.starts_with('*') && word.size() > 1) return MeshFormat::kInp;
    if (is_off_without_keyword(content)) return MeshFormat::kOff;
    return is_bulk_data(content) ? std::optional(MeshFormat::kBdf) : std::nullopt;
}

}  // namespace

std::optional<MeshFormat> detect_format(Bytes bytes) {
    if (has_stl_length(bytes)) return MeshFormat::kStlBinary;
    const std::string_view window = as_text(bytes.first(std::min(bytes.size(), kWindow)));
    const std::string_view text = as_text(bytes.first(std::min(bytes.size(), 2 * kMostComments)));
    if (const std::optional<MeshFormat> format = detect_by_mark(text)) return format;
    if (const std::optional<MeshFormat> format = detect_by_word(without_mark(text), has_controls(window))) return format;
    if (!is_text(window) && resembles_binary_stl(bytes)) return MeshFormat::kStlBinary;
    return {};
}

std::optional<MeshFormat> format_where_bytes_do_not_tell(Bytes bytes, std::string_view file_name) {
    if (detect_format(bytes)) return {};
    const Expected<MeshFormat> named = format_by_extension(file_name);
    if (!named) return {};
    const bool has_no_mark =
        *named == MeshFormat::kObj || *named == MeshFormat::kOff || *named == MeshFormat::kInp || *named == MeshFormat::kBdf;
    return has_no_mark ? std::optional(*named) : std::nullopt;
}

}  // namespace vsplit

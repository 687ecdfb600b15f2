#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "base/byte_order.h"
#include "io/off_header.h"
#include "io/stl_layout.h"
#include "io/text_lines.h"
#include "vsplit/io/mesh_format.h"

namespace vsplit {
namespace {

using Bytes = std::span<const std::byte>;

constexpr std::size_t kWindow = 4096;

/// Whether the bytes could be ASCII or UTF-8: no control characters but white space, no byte that UTF-8 never has.
bool is_text(std::string_view bytes) {
    return std::none_of(bytes.begin(), bytes.end(), [](char c) {
        const auto code = static_cast<unsigned char>(c);
        return code < '\t' || (code > '\r' && code < ' ') || code == 0xC0 || code == 0xC1 || code > 0xF4;
    });
}

/// Files of numbers as bytes have zeros among the first few; damaged text may have any byte but seldom that one.
bool has_zeros(std::string_view bytes) { return bytes.find('\0') != std::string_view::npos; }

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

bool is_obj_keyword(std::string_view word) {
    constexpr std::array<std::string_view, 15> kKeywords = {"v", "vn", "vt", "vp", "f",      "fo",     "o",  "g",
                                                            "s", "l",  "p",  "mg", "mtllib", "usemtl", "lod"};
    return std::find(kKeywords.begin(), kKeywords.end(), word) != kKeywords.end();
}

/// By the first word that is no comment.
std::optional<MeshFormat> detect_by_word(std::string_view text) {
    TextLines lines(text);
    // Comments as far as one can see: STL has none, OFF seldom more than a line.
    if (!lines.next_content('#'))
        return text.find('#') == std::string_view::npos ? std::nullopt : std::optional(MeshFormat::kObj);
    std::string_view rest = lines.line();
    const std::string_view word = next_word(rest);
    if (is_off_keyword(word)) return MeshFormat::kOff;
    if (has_zeros(text)) return {};  // the header of a binary STL may begin with any word
    if (equals_ignoring_case(word, "solid")) return MeshFormat::kStlAscii;
    if (is_obj_keyword(word)) return MeshFormat::kObj;
    return {};
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

/// Nastran's cards and the lines around them, as far as one can see.
bool has_nastran_line(std::string_view text) {
    constexpr std::array<std::string_view, 11> kBegins = {"BEGIN BULK", "GRID", "CTRIA", "CQUAD",  "ENDDATA", "NASTRAN ",
                                                          "SOL ",       "CEND", "MAT1",  "PSHELL", "ID "};
    TextLines lines(text);
    while (lines.next()) {
        const std::string line = upper_case(lines.line());
        if (std::any_of(kBegins.begin(), kBegins.end(), [&](std::string_view begin) { return line.starts_with(begin); }))
            return true;
        if (!trimmed(line).empty() && !line.starts_with('$')) return false;
    }
    return false;
}

std::optional<MeshFormat> detect_for_solvers(std::string_view text) {
    if (text.starts_with("# vtk DataFile")) return kind_of_vtk(text);
    std::string_view rest = text;
    const std::string_view word = next_word(rest);
    if (word == "$MeshFormat" || (word == "$Comments" && text.find("$MeshFormat") != std::string_view::npos))
        return kind_of_msh(text);
    const bool xml = word.starts_with("<?xml") || word.starts_with("<VTKFile") || word.starts_with("<!--");
    if (xml && text.find("<VTKFile") != std::string_view::npos) return MeshFormat::kVtu;
    if (has_zeros(text)) return {};
    if (word.starts_with('*') && word.size() > 1) return MeshFormat::kInp;
    return has_nastran_line(text) ? std::optional(MeshFormat::kBdf) : std::nullopt;
}

}  // namespace

std::optional<MeshFormat> detect_format(Bytes bytes) {
    if (has_stl_length(bytes)) return MeshFormat::kStlBinary;
    const std::string_view window = as_text(bytes.first(std::min(bytes.size(), kWindow)));
    if (window.starts_with("PK\x03\x04")) return MeshFormat::k3mf;  // no other format that is read is a zip archive
    if (window.starts_with("ply\n") || window.starts_with("ply\r\n")) return kind_of_ply(window);
    if (const std::optional<MeshFormat> format = detect_for_solvers(without_mark(window))) return format;
    if (const std::optional<MeshFormat> format = detect_by_word(without_mark(window))) return format;
    if (!is_text(window) && resembles_binary_stl(bytes)) return MeshFormat::kStlBinary;
    return {};
}

}  // namespace vsplit

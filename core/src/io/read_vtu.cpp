#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "io/number_stream.h"
#include "io/read_error.h"
#include "io/readers.h"
#include "io/text_lines.h"
#include "io/vtk_cells.h"
#include "io/vtu_array.h"
#include "io/xml_tags.h"

namespace vsplit {
namespace {

using Kind = NumberStream::Kind;

/// An array whose numbers have not been looked at yet.
struct VtuArray {
    std::size_t line = 0;
    Kind kind = Kind::kFloat64;
    std::string_view format;
    std::string_view text;     ///< of an array that stands in its tag
    std::uint64_t offset = 0;  ///< of one that stands behind all tags
    std::uint64_t components = 1;
};

std::optional<Kind> kind_of(std::string_view name) {
    static const std::map<std::string_view, Kind> kinds{
        {"Int8", Kind::kInt8},       {"UInt8", Kind::kUint8},    {"Int16", Kind::kInt16}, {"UInt16", Kind::kUint16},
        {"Int32", Kind::kInt32},     {"UInt32", Kind::kUint32},  {"Int64", Kind::kInt64}, {"UInt64", Kind::kUint64},
        {"Float32", Kind::kFloat32}, {"Float64", Kind::kFloat64}};
    const auto found = kinds.find(name);
    return found == kinds.end() ? std::nullopt : std::optional(found->second);
}

/// Reads a VTU file of one piece, its arrays as text, base64 or appended, compressed by zlib or not.
class VtuFile {
public:
    VtuFile(std::span<const std::byte> bytes, std::uint32_t max_faces)
        : text_(without_mark(as_text(bytes))), tags_(text_), cells_(max_faces) {
        encoding_.most_bytes = (std::size_t{1} << 20U) + std::size_t{64} * max_faces;
    }

    Expected<TriangleMesh> read() {
        if (Status read = read_tags(); !read) return read.error();
        for (const auto step : {&VtuFile::use_points, &VtuFile::use_cells, &VtuFile::use_regions}) {
            if (Status used = (this->*step)(); !used) return used.error();
        }
        return cells_.take();
    }

private:
    Status read_tags() {
        for (;;) {
            const Expected<std::optional<XmlTag>> tag = tags_.next();
            if (!tag) return tag.error();
            if (!*tag || (*tag)->name == "/VTKFile") return Done{};
            if (Status taken = take_tag(**tag); !taken) return taken;
            if ((*tag)->name == "AppendedData") return begin_appended(**tag);
        }
    }

    Status take_tag(const XmlTag& tag) {
        if (tag.name == "VTKFile") return take_file(tag);
        if (tag.name == "Piece" && std::exchange(has_piece_, true))
            return error(tag.line, Cause::kUnsupported, "a second piece is not read; merge the pieces into one");
        if (tag.name == "DataArray") return take_array(tag);
        if (tag.name.starts_with('/') || tag.closed) return Done{};
        if (tag.name == "Points" || tag.name == "Cells" || tag.name == "CellData" || tag.name == "PointData" ||
            tag.name == "FieldData")
            part_ = tag.name;
        return Done{};
    }

    Status take_file(const XmlTag& tag) {
        if (tag.attribute("type") != "UnstructuredGrid") {
            return error(tag.line, Cause::kUnsupported,
                         "a file of type " + quoted(tag.attribute("type")) + " is not read; UnstructuredGrid is");
        }
        if (tag.attribute("byte_order") == "BigEndian") encoding_.order = std::endian::big;
        if (tag.attribute("header_type") == "UInt64") encoding_.header = 8;
        const std::string_view compressor = tag.attribute("compressor");
        encoding_.zlib = compressor == "vtkZLibDataCompressor";
        if (encoding_.zlib || compressor.empty()) return Done{};
        return error(tag.line, Cause::kUnsupported, quoted(compressor) + " is not read; vtkZLibDataCompressor or none is");
    }

    Status take_array(const XmlTag& tag) {
        const std::optional<Kind> kind = kind_of(tag.attribute("type"));
        if (!kind) return Done{};  // of strings; if it was needed, it will be missed
        VtuArray array{tag.line, *kind, tag.attribute("format"), trimmed(tags_.text_ahead()), 0, 1};
        if (const std::string_view n = tag.attribute("NumberOfComponents"); !n.empty())
            array.components = static_cast<std::uint64_t>(parse_integer(n).value_or(0));
        if (array.format == "appended") {
            const std::optional<std::int64_t> offset = parse_integer(tag.attribute("offset"));
            if (!offset || *offset < 0)
                return error(tag.line, Cause::kMalformedInput, "expected an offset, " + found(tag.attribute("offset")));
            array.offset = static_cast<std::uint64_t>(*offset);
        }
        arrays_[{part_, part_ == "Points" ? std::string_view() : tag.attribute("Name")}] = array;
        return Done{};
    }

    /// They begin behind an underscore.
    Status begin_appended(const XmlTag& tag) {
        const std::size_t mark = text_.find('_', tag.end);
        if (mark == std::string_view::npos)
            return error(tag.line, Cause::kMalformedInput, "expected '_' before the appended bytes");
        appended_ = text_.substr(mark + 1);
        appended_base64_ = tag.attribute("encoding") == "base64";
        return Done{};
    }

    Expected<std::vector<double>> numbers(const VtuArray& array) const {
        std::vector<double> numbers;
        if (array.format == "ascii") {
            std::string_view rest = array.text;
            for (std::string_view word = next_word(rest); !word.empty(); word = next_word(rest)) {
                const std::optional<double> value = parse_number(word);
                if (!value) return error(array.line, Cause::kMalformedInput, "expected a number, " + found(word)).error();
                numbers.push_back(*value);
            }
            return numbers;
        }
        const bool appended = array.format == "appended";
        if (appended && array.offset > appended_.size())
            return error(array.line, Cause::kTruncatedInput, "the array begins behind the file's end").error();
        const std::string_view from = appended ? appended_.substr(array.offset) : array.text;
        const Expected<std::vector<std::byte>> bytes =
            decode_vtu_array(from, !appended || appended_base64_, encoding_, at_line(array.line));
        if (!bytes) return bytes.error();
        NumberStream stream(*bytes);
        stream.set_binary(encoding_.order);
        while (stream.ok() && stream.left() > 0) numbers.push_back(stream.number(array.kind, "a number of an array"));
        if (!stream.ok()) return error(array.line, Cause::kMalformedInput, "an array ends within a number").error();
        return numbers;
    }

    Expected<std::vector<double>> required(std::string_view part, std::string_view name) const {
        const auto found = arrays_.find({part, name});
        if (found != arrays_.end()) return numbers(found->second);
        return Error{Cause::kMalformedInput,
                     "line 1: the file has no " + std::string(part) + (name.empty() ? "" : " array ") + std::string(name), ""};
    }

    Expected<std::vector<std::int64_t>> integers(std::string_view part, std::string_view name) const {
        const Expected<std::vector<double>> values = required(part, name);
        if (!values) return values.error();
        std::vector<std::int64_t> result;
        constexpr double kMost = 9e15;
        for (const double value : *values) {
            if (!(value >= 0 && value <= kMost)) {
                return error(line_of(part, name), Cause::kMalformedInput,
                             "expected an integer of 0 or more in " + std::string(name) + ", found " + to_text(value))
                    .error();
            }
            result.push_back(static_cast<std::int64_t>(value));
        }
        return result;
    }

    [[nodiscard]] std::size_t line_of(std::string_view part, std::string_view name) const {
        const auto found = arrays_.find({part, name});
        return found == arrays_.end() ? 1 : found->second.line;
    }

    Status use_points() {
        const Expected<std::vector<double>> values = required("Points", "");
        if (!values) return values.error();
        const Place place = at_line(line_of("Points", ""));
        if (values->size() % 3 != 0)
            return read_error(Cause::kMalformedInput, place, "points do not have three coordinates each");
        for (std::size_t i = 0; i < values->size(); i += 3) {
            const Vec3 point((*values)[i], (*values)[i + 1], (*values)[i + 2]);
            if (Status added = cells_.add_point(point, place); !added) return added;
        }
        return Done{};
    }

    Status use_cells() {
        Expected<std::vector<std::int64_t>> points = integers("Cells", "connectivity");
        if (!points) return points.error();
        const Expected<std::vector<std::int64_t>> offsets = integers("Cells", "offsets");
        if (!offsets) return offsets.error();
        Expected<std::vector<std::int64_t>> types = integers("Cells", "types");
        if (!types) return types.error();
        cells_.set_types(*std::move(types));
        return cells_.set_offsets(*offsets, *std::move(points), at_line(line_of("Cells", "offsets")));
    }

    Status use_regions() {
        for (const auto& [key, array] : arrays_) {
            if (key.first != "CellData" || array.components != 1 || !is_region_name(key.second)) continue;
            const Expected<std::vector<double>> values = numbers(array);
            if (!values) return values.error();
            return cells_.set_regions(*values, at_line(array.line));
        }
        return Done{};
    }

    static Status error(std::size_t line, Cause cause, const std::string& what) { return read_error(cause, at_line(line), what); }

    std::string_view text_;
    XmlTags tags_;
    VtkCells cells_;
    VtuEncoding encoding_;
    std::string_view part_;
    bool has_piece_ = false;
    std::map<std::pair<std::string_view, std::string_view>, VtuArray> arrays_;
    std::string_view appended_;
    bool appended_base64_ = false;
};

}  // namespace

Expected<TriangleMesh> read_vtu(std::span<const std::byte> bytes, std::uint32_t max_faces) {
    return VtuFile(bytes, max_faces).read();
}

}  // namespace vsplit

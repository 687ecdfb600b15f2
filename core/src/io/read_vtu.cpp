#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "io/number_stream.h"
#include "io/read_error.h"
#include "io/readers.h"
#include "io/region_value.h"
#include "io/text_lines.h"
#include "io/vtk_cells.h"
#include "io/vtu_array.h"
#include "io/xml_tags.h"

namespace vsplit {
namespace {

using Kind = NumberStream::Kind;

/// An array whose numbers have not been looked at yet.
struct VtuArray {
    Place place = at_line(1);  ///< of its tag
    Kind kind = Kind::kFloat64;
    bool is_text = false;      ///< else bytes
    bool is_appended = false;  ///< stands behind all tags, at `offset`
    std::uint64_t offset = 0;
    std::string_view text;  ///< between its tags
    XmlPosition begin;      ///< of that text
    std::optional<std::int64_t> components;
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
        for (const auto step : {&VtuFile::read_tags, &VtuFile::use_points, &VtuFile::use_cells, &VtuFile::use_regions}) {
            if (Status done = (this->*step)(); !done) return done.error();
        }
        return cells_.take();
    }

private:
    /// To the end of all, or to the bytes behind them.
    Status read_tags() {
        XmlNesting nesting;
        while (!nesting.ended()) {
            const Expected<std::optional<XmlTag>> tag = tags_.next();
            if (!tag) return tag.error();
            if (!*tag) return nesting.end(tags_.position().place());
            if (Status nests = nesting.take(**tag); !nests) return nests;
            if ((*tag)->name == "AppendedData") return begin_appended(**tag);
            if ((*tag)->ends) continue;
            if (Status taken = take_tag(**tag); !taken) return taken;
        }
        return Done{};
    }

    Status take_tag(const XmlTag& tag) {
        if (tag.name == "VTKFile") return take_file(tag);
        if (tag.name == "Piece") return take_piece(tag);
        if (tag.name == "DataArray") return take_array(tag);
        constexpr std::array<std::string_view, 5> kParts = {"Points", "Cells", "CellData", "PointData", "FieldData"};
        if (std::find(kParts.begin(), kParts.end(), tag.name) != kParts.end()) part_ = tag.name;
        return Done{};
    }

    Status take_piece(const XmlTag& tag) {
        if (piece_) return read_error(Cause::kUnsupported, tag.place, "a second piece is not read; merge the pieces into one");
        piece_ = tag.place;
        const Expected<std::uint64_t> points = announced(tag, "NumberOfPoints");
        const Expected<std::uint64_t> cells = announced(tag, "NumberOfCells");
        if (!points) return points.error();
        if (!cells) return cells.error();
        announced_points_ = *points;
        announced_cells_ = *cells;
        return Done{};
    }

    static Expected<std::uint64_t> announced(const XmlTag& tag, std::string_view key) {
        const std::string_view text = tag.attribute(key);
        const std::optional<std::int64_t> value = parse_integer(text);
        if (value && *value >= 0) return static_cast<std::uint64_t>(*value);
        return read_error(Cause::kMalformedInput, tag.place,
                          "expected an integer of 0 or more as " + std::string(key) + " of the piece, " +
                              (text.empty() ? "found none" : found(text)));
    }

    Status take_file(const XmlTag& tag) {
        if (tag.attribute("type") != "UnstructuredGrid") {
            return read_error(Cause::kUnsupported, tag.place,
                              "a file of type " + quoted(tag.attribute("type")) + " is not read; UnstructuredGrid is");
        }
        if (tag.attribute("byte_order") == "BigEndian") encoding_.order = std::endian::big;
        if (tag.attribute("header_type") == "UInt64") encoding_.header = 8;
        const std::string_view compressor = tag.attribute("compressor");
        encoding_.zlib = compressor == "vtkZLibDataCompressor";
        if (encoding_.zlib || compressor.empty()) return Done{};
        return read_error(Cause::kUnsupported, tag.place, quoted(compressor) + " is not read; vtkZLibDataCompressor or none is");
    }

    Status take_array(const XmlTag& tag) {
        const std::optional<Kind> kind = kind_of(tag.attribute("type"));
        if (!kind) return Done{};  // of strings; if it was needed, it will be missed
        VtuArray array;
        array.place = tag.place;
        array.kind = *kind;
        const std::string_view format = tag.attribute("format");
        array.is_appended = format == "appended";
        array.is_text = format.empty() || format == "ascii";
        if (!array.is_appended && !array.is_text && format != "binary")
            return read_error(Cause::kMalformedInput, tag.place, "expected 'ascii', 'binary' or 'appended', " + found(format));
        array.text = tag.closed ? std::string_view() : tags_.text_ahead();
        array.begin = tags_.position();
        if (const std::string_view n = tag.attribute("NumberOfComponents"); !n.empty())
            array.components = parse_integer(n).value_or(0);
        if (array.is_appended) {
            const std::optional<std::int64_t> offset = parse_integer(tag.attribute("offset"));
            if (!offset || *offset < 0)
                return read_error(Cause::kMalformedInput, tag.place, "expected an offset, " + found(tag.attribute("offset")));
            array.offset = static_cast<std::uint64_t>(*offset);
        }
        arrays_[{part_, part_ == "Points" ? std::string_view() : tag.attribute("Name")}] = array;
        return Done{};
    }

    /// They begin behind an underscore.
    Status begin_appended(const XmlTag& tag) {
        const std::size_t mark = text_.find('_', tag.end);
        if (mark == std::string_view::npos)
            return read_error(Cause::kMalformedInput, tag.place, "expected '_' before the appended bytes");
        appended_ = text_.substr(mark + 1);
        appended_base64_ = tag.attribute("encoding") == "base64";
        return Done{};
    }

    /// Of text the number's, else the array's.
    static Place place_of(const VtuArray& array, std::size_t number) {
        if (!array.is_text) return array.place;
        std::string_view rest = array.text;
        std::string_view word = next_word(rest);
        for (std::size_t i = 0; i < number && !word.empty(); ++i) word = next_word(rest);
        XmlPosition position = array.begin;
        position.pass(array.text.substr(0, static_cast<std::size_t>(word.data() - array.text.data())));
        return position.place();
    }

    static Expected<std::vector<double>> numbers_of_text(const VtuArray& array) {
        std::vector<double> numbers;
        std::string_view rest = array.text;
        for (std::string_view word = next_word(rest); !word.empty(); word = next_word(rest)) {
            const std::optional<double> value = parse_number(word);
            if (!value)
                return read_error(Cause::kMalformedInput, place_of(array, numbers.size()), "expected a number, " + found(word));
            numbers.push_back(*value);
        }
        return numbers;
    }

    Expected<std::vector<double>> numbers_of_bytes(const VtuArray& array) const {
        if (array.is_appended && array.offset > appended_.size())
            return read_error(Cause::kTruncatedInput, array.place, "the array begins behind the file's end");
        const std::string_view from = array.is_appended ? appended_.substr(array.offset) : array.text;
        const Expected<std::vector<std::byte>> bytes =
            decode_vtu_array(from, !array.is_appended || appended_base64_, encoding_, array.place);
        if (!bytes) return bytes.error();
        NumberStream stream(*bytes);
        stream.set_binary(encoding_.order);
        std::vector<double> numbers;
        while (stream.ok() && stream.left() > 0) numbers.push_back(stream.number(array.kind, "a number of an array"));
        if (!stream.ok()) return read_error(Cause::kMalformedInput, array.place, "an array ends within a number");
        return numbers;
    }

    Expected<PlacedNumbers<double>> numbers(const VtuArray& array) const {
        Expected<std::vector<double>> values = array.is_text ? numbers_of_text(array) : numbers_of_bytes(array);
        if (!values) return values.error();
        return PlacedNumbers<double>{*std::move(values), [&array](std::size_t i) { return place_of(array, i); }};
    }

    Expected<PlacedNumbers<double>> required(std::string_view part, std::string_view name) const {
        const auto found = arrays_.find({part, name});
        if (found != arrays_.end()) return numbers(found->second);
        return read_error(Cause::kMalformedInput, piece_.value_or(at_line(1)),
                          "the file has no " + std::string(part) + (name.empty() ? "" : " array ") + std::string(name));
    }

    Expected<PlacedNumbers<std::int64_t>> integers(std::string_view name) const {
        const Expected<PlacedNumbers<double>> numbers = required("Cells", name);
        if (!numbers) return numbers.error();
        PlacedNumbers<std::int64_t> result{{}, numbers->place_of};
        constexpr double kMost = 9e15;
        for (const double value : numbers->values) {
            if (!(value >= 0 && value <= kMost && value == std::trunc(value))) {
                return read_error(Cause::kMalformedInput, numbers->place_of(result.values.size()),
                                  "expected an integer of 0 or more in " + std::string(name) + ", found " + to_text(value));
            }
            result.values.push_back(static_cast<std::int64_t>(value));
        }
        return result;
    }

    Status use_points() {
        const Expected<PlacedNumbers<double>> points = required("Points", "");
        if (!points) return points.error();
        const VtuArray& array = arrays_.at({"Points", ""});
        if (array.components.value_or(3) != 3) {
            return read_error(Cause::kMalformedInput, array.place,
                              "expected points of 3 components, found " + std::to_string(*array.components));
        }
        if (points->values.size() != 3 * announced_points_) {
            return read_error(Cause::kMalformedInput, array.place,
                              "expected 3 coordinates for each of " + std::to_string(announced_points_) + " points, found " +
                                  std::to_string(points->values.size()) + " numbers");
        }
        for (std::size_t i = 0; i < points->values.size(); i += 3) {
            const Vec3 point(points->values[i], points->values[i + 1], points->values[i + 2]);
            if (cells_.add_point(point, array.place)) continue;
            return cells_.add_point(point, points->place_of(i));  // for the place, which takes a search
        }
        return Done{};
    }

    Status use_cells() {
        Expected<PlacedNumbers<std::int64_t>> points = integers("connectivity");
        if (!points) return points.error();
        const Expected<PlacedNumbers<std::int64_t>> ends = integers("offsets");
        if (!ends) return ends.error();
        Expected<PlacedNumbers<std::int64_t>> types = integers("types");
        if (!types) return types.error();
        if (ends->values.size() != announced_cells_) {
            return read_error(Cause::kMalformedInput, arrays_.at({"Cells", "offsets"}).place,
                              std::to_string(announced_cells_) + " cells are announced, but there are " +
                                  std::to_string(ends->values.size()) + " offsets");
        }
        cells_.set_types(*std::move(types));
        return cells_.add_ends(ends->values, ends->place_of, *points, VtkCells::kPolygon);
    }

    Status use_regions() {
        for (const auto& [key, array] : arrays_) {
            if (key.first != "CellData" || array.components.value_or(1) != 1 || !is_region_name(key.second)) continue;
            const Expected<PlacedNumbers<double>> values = numbers(array);
            if (!values) return values.error();
            return cells_.set_regions(*values);
        }
        return Done{};
    }

    std::string_view text_;
    XmlTags tags_;
    VtkCells cells_;
    VtuEncoding encoding_;
    std::string_view part_;
    std::optional<Place> piece_;
    std::uint64_t announced_points_ = 0;
    std::uint64_t announced_cells_ = 0;
    std::map<std::pair<std::string_view, std::string_view>, VtuArray> arrays_;
    std::string_view appended_;
    bool appended_base64_ = false;
};

}  // namespace

Expected<TriangleMesh> read_vtu(std::span<const std::byte> bytes, std::uint32_t max_faces) {
    return VtuFile(bytes, max_faces).read();
}

}  // namespace vsplit

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "io/element_builder.h"
#include "io/number_stream.h"
#include "io/read_error.h"
#include "io/readers.h"
#include "io/region_value.h"
#include "io/text_lines.h"
#include "io/vtk_cells.h"

namespace vsplit {
namespace {

using Kind = NumberStream::Kind;

std::optional<Kind> kind_of(std::string_view name) {
    struct Known {
        std::string_view name;
        Kind kind;
    };
    static constexpr std::array<Known, 16> kKnown = {{{"char", Kind::kInt8},
                                                      {"signed_char", Kind::kInt8},
                                                      {"unsigned_char", Kind::kUint8},
                                                      {"short", Kind::kInt16},
                                                      {"unsigned_short", Kind::kUint16},
                                                      {"int", Kind::kInt32},
                                                      {"unsigned_int", Kind::kUint32},
                                                      {"long", Kind::kInt64},
                                                      {"unsigned_long", Kind::kUint64},
                                                      {"vtktypeint64", Kind::kInt64},
                                                      {"vtktypeint32", Kind::kInt32},
                                                      {"vtktypeuint64", Kind::kUint64},
                                                      {"vtktypeuint32", Kind::kUint32},
                                                      {"vtkIdType", Kind::kInt64},
                                                      {"float", Kind::kFloat32},
                                                      {"double", Kind::kFloat64}}};
    for (const Known& known : kKnown) {
        if (equals_ignoring_case(known.name, name)) return known.kind;
    }
    return {};
}

/// Reads a legacy VTK file of POLYDATA or an UNSTRUCTURED_GRID, text or bytes (big-endian), to version 5.1. Points and cells are
/// read, and of the cells' data a scalar of integers that is called region (see is_region_name).
class VtkFile {
public:
    VtkFile(std::span<const std::byte> bytes, std::uint32_t max_faces) : in_(bytes), cells_(max_faces) {}

    Expected<TriangleMesh> read() {
        read_header();
        while (in_.ok() && in_.more()) read_part();
        if (grid_ && !has_types_ && cells_.cell_count() > 0) in_.fail(Cause::kTruncatedInput, "the file ends before CELL_TYPES");
        if (!in_.ok()) return in_.error();
        return cells_.take();
    }

private:
    void read_header() {
        const std::string_view first = in_.line();
        if (!first.starts_with("# vtk DataFile Version"))
            return in_.fail(Cause::kMalformedInput, "expected '# vtk DataFile Version', " + found(first));
        static_cast<void>(in_.line());  // a title
        const std::string_view encoding = in_.word();
        binary_ = equals_ignoring_case(encoding, "BINARY");
        if (!binary_ && !equals_ignoring_case(encoding, "ASCII"))
            return in_.fail(Cause::kMalformedInput, "expected ASCII or BINARY, " + found(encoding));
        const std::string keyword = upper_case(in_.word());
        if (keyword != "DATASET") return in_.fail(Cause::kMalformedInput, "expected DATASET, " + found(keyword));
        const std::string kind = upper_case(in_.word());
        if (kind != "POLYDATA" && kind != "UNSTRUCTURED_GRID") {
            in_.fail(Cause::kUnsupported, "a dataset of " + quoted(kind) + " is not read; POLYDATA and UNSTRUCTURED_GRID are");
        }
        grid_ = kind == "UNSTRUCTURED_GRID";
    }

    void read_part() {
        const std::string keyword = upper_case(in_.word());
        if (keyword == "METADATA") return skip_metadata();
        if (keyword == "FIELD") return read_field();
        if (keyword == "POINT_DATA" || keyword == "CELL_DATA") return begin_data(keyword == "CELL_DATA");
        if (in_data_) return read_attribute(keyword);
        if (keyword == "POINTS") return read_points();
        if (keyword == "POLYGONS" || (grid_ && keyword == "CELLS")) return read_cells(VtkCells::kPolygon);
        if (keyword == "TRIANGLE_STRIPS") return read_cells(VtkCells::kStrip);
        if (keyword == "CELL_TYPES") return read_types();
        if (keyword == "VERTICES" || keyword == "LINES") return skip_cells();
        in_.fail(Cause::kMalformedInput, "expected a part of a dataset, " + found(keyword));
    }

    template <class Read>
    void with_numbers(Read read) {
        if (binary_) {
            static_cast<void>(in_.line());  // the rest of the keyword's line
            in_.set_binary(std::endian::big);
        }
        read();
        in_.set_text();
    }

    Kind read_kind() {
        const std::string_view name = in_.word();
        const std::optional<Kind> kind = kind_of(name);
        if (!kind) in_.fail(Cause::kMalformedInput, "expected a type of numbers, " + found(name));
        return kind.value_or(Kind::kFloat64);
    }

    void read_points() {
        const std::uint64_t count = in_.count(Kind::kInt64, "the number of points", in_.left());
        const Kind kind = read_kind();
        with_numbers([&] {
            for (std::uint64_t i = 0; i < count && in_.ok(); ++i) {
                Vec3 point;
                for (int axis = 0; axis < 3; ++axis) point[axis] = in_.number(kind, "a coordinate");
                if (in_.ok()) in_.keep(cells_.add_point(point, in_.place()));
            }
        });
    }

    /// Of the numbers that follow: they are read again for it.
    [[nodiscard]] PlaceOf places_ahead(Kind kind) const {
        return [start = in_, kind](std::size_t number) {
            NumberStream again = start;
            for (std::size_t i = 0; i <= number && again.ok(); ++i) static_cast<void>(again.number(kind, "a number"));
            return again.place();
        };
    }

    PlacedNumbers<std::int64_t> read_integers(std::uint64_t count, Kind kind, const char* what) {
        PlacedNumbers<std::int64_t> numbers;
        with_numbers([&] {
            numbers.place_of = places_ahead(kind);
            for (std::uint64_t i = 0; i < count && in_.ok(); ++i) numbers.values.push_back(in_.integer(kind, what));
        });
        return numbers;
    }

    /// To version 4 a cell is its number of points and the points; from 5 on there are offsets and all points.
    void read_cells(std::int64_t type) {
        // The cells' data has strips last, wherever they stand.
        if (type != VtkCells::kStrip && has_strips_)
            return in_.fail(Cause::kUnsupported, "POLYGONS behind TRIANGLE_STRIPS are not read; before them they are");
        has_strips_ = has_strips_ || type == VtkCells::kStrip;
        const std::uint64_t first = in_.count(Kind::kInt64, "the number of cells", in_.left());
        const std::uint64_t second = in_.count(Kind::kInt64, "the number of numbers", in_.left());
        if (!has_offsets()) {
            const PlacedNumbers<std::int64_t> runs = read_integers(second, Kind::kInt32, "a point of a cell");
            if (in_.ok()) in_.keep(cells_.add_runs(runs, first, type));
            return;
        }
        const PlacedNumbers<std::int64_t> offsets = read_array("OFFSETS", first);
        const PlacedNumbers<std::int64_t> points = read_array("CONNECTIVITY", second);
        if (!in_.ok()) return;
        if (!offsets.values.empty() && offsets.values[0] != 0) {
            return in_.fail_at(offsets.place_of(0), Cause::kMalformedInput,
                               "expected the first offset to be 0, found " + std::to_string(offsets.values[0]));
        }
        const auto ends = std::span(offsets.values).subspan(offsets.values.empty() ? 0 : 1);
        in_.keep(cells_.add_ends(
            ends, [&](std::size_t i) { return offsets.place_of(i + 1); }, points, type));
    }

    /// Whether the word OFFSETS follows: the only sign of it, as versions are often wrong.
    bool has_offsets() {
        NumberStream ahead = in_;
        return ahead.word() == "OFFSETS";
    }

    PlacedNumbers<std::int64_t> read_array(std::string_view name, std::uint64_t count) {
        in_.expect(name);
        const Kind kind = read_kind();
        return read_integers(count, kind, "a number of a cell");
    }

    void skip_cells() {
        const std::uint64_t first = in_.count(Kind::kInt64, "the number of cells", in_.left());
        const std::uint64_t second = in_.count(Kind::kInt64, "the number of numbers", in_.left());
        std::uint64_t cells = first;
        if (has_offsets()) {
            static_cast<void>(read_array("OFFSETS", first));
            static_cast<void>(read_array("CONNECTIVITY", second));
            cells = first == 0 ? 0 : first - 1;
        } else {
            static_cast<void>(read_integers(second, Kind::kInt32, "a point of a cell"));
        }
        cells_.skip_before(cells);
    }

    void read_types() {
        has_types_ = true;
        const std::uint64_t count = in_.count(Kind::kInt64, "the number of cells", in_.left());
        cells_.set_types(read_integers(count, Kind::kInt32, "a cell's type"));
    }

    void begin_data(bool of_cells) {
        in_data_ = true;
        of_cells_ = of_cells;
        tuples_ = in_.count(Kind::kInt64, of_cells ? "the number of cells" : "the number of points", in_.left());
    }

    /// Data of points and what of cells is no region is read over: of bytes nobody knows otherwise where they end.
    void read_attribute(const std::string& keyword) {
        struct Known {
            std::string_view keyword;
            std::uint64_t components;
        };
        static constexpr std::array<Known, 7> kKnown = {{{"VECTORS", 3},
                                                         {"NORMALS", 3},
                                                         {"TENSORS", 9},
                                                         {"TENSORS6", 6},
                                                         {"GLOBAL_IDS", 1},
                                                         {"PEDIGREE_IDS", 1},
                                                         {"EDGE_FLAGS", 1}}};
        if (keyword == "SCALARS") return read_scalars();
        if (keyword == "COLOR_SCALARS") return skip_colours(tuples_);
        if (keyword == "LOOKUP_TABLE") return skip_lookup_table();
        if (keyword == "TEXTURE_COORDINATES") {
            static_cast<void>(in_.word());
            const std::uint64_t components = in_.count(Kind::kInt64, "a number of components", kMostComponents);
            return take_data("", read_kind(), tuples_, components);
        }
        for (const Known& known : kKnown) {
            if (known.keyword != keyword) continue;
            static_cast<void>(in_.word());
            return take_data("", read_kind(), tuples_, known.components);
        }
        in_.fail(Cause::kMalformedInput, "expected data of points or cells, such as SCALARS or FIELD, " + found(keyword));
    }

    void read_scalars() {
        const std::string name(in_.word());
        std::string_view rest = in_.line();
        const std::string_view type = next_word(rest);
        const auto components = static_cast<std::uint64_t>(parse_integer(next_word(rest)).value_or(1));
        if (components < 1 || components > 4) return in_.fail(Cause::kMalformedInput, "expected 1 to 4 components");
        in_.expect("LOOKUP_TABLE");
        static_cast<void>(in_.word());
        take_array(name, type, tuples_, components);
    }

    void take_array(const std::string& name, std::string_view type, std::uint64_t tuples, std::uint64_t components) {
        if (const std::optional<Kind> kind = kind_of(type)) return take_data(name, *kind, tuples, components);
        if (components > kMostComponents || tuples > in_.left())
            return in_.fail(Cause::kTruncatedInput, "an array is longer than the file");
        const std::uint64_t count = tuples * components;
        if (type == "bit") return take_data("", binary_ ? Kind::kUint8 : Kind::kInt8, binary_ ? (count + 7) / 8 : count, 1);
        if (type != "string" || binary_) return in_.fail(Cause::kUnsupported, "an array of " + quoted(type) + " is not read");
        static_cast<void>(in_.line());
        for (std::uint64_t i = 0; i < count && in_.ok() && in_.left() > 0; ++i) static_cast<void>(in_.line());
    }

    /// As bytes they are of 0 to 255, as text of 0 to 1.
    void skip_colours(std::uint64_t tuples) {
        static_cast<void>(in_.word());
        const std::uint64_t components = in_.count(Kind::kInt64, "a number of components", kMostComponents);
        take_data("", Kind::kUint8, tuples, components);
    }

    void skip_lookup_table() {
        static_cast<void>(in_.word());
        const std::uint64_t colours = in_.count(Kind::kInt64, "a number of colours", in_.left());
        take_data("", Kind::kUint8, colours, 4);
    }

    void read_field() {
        static_cast<void>(in_.word());  // its name
        const std::uint64_t arrays = in_.count(Kind::kInt64, "the number of arrays", in_.left());
        for (std::uint64_t i = 0; i < arrays && in_.ok(); ++i) {
            if (in_.more() && NumberStream(in_).word() == "METADATA") {
                static_cast<void>(in_.word());
                skip_metadata();
            }
            const std::string name(in_.word());
            const std::uint64_t components = in_.count(Kind::kInt64, "a number of components", in_.left());
            const std::uint64_t tuples = in_.count(Kind::kInt64, "a number of tuples", in_.left());
            const std::string_view type = in_.word();
            take_array(tuples == tuples_ ? name : "", type, tuples, components);
        }
    }

    void take_data(const std::string& name, Kind kind, std::uint64_t tuples, std::uint64_t components) {
        PlacedNumbers<double> data;
        const bool wanted = in_data_ && of_cells_ && components == 1 && is_region_name(name);
        with_numbers([&] {
            data.place_of = places_ahead(kind);
            for (std::uint64_t i = 0; i < tuples && in_.ok(); ++i) {
                for (std::uint64_t c = 0; c < components && in_.ok(); ++c) {
                    const double value = in_.number(kind, of_cells_ ? "a value of a cell" : "a value of a point");
                    if (wanted) data.values.push_back(value);
                }
            }
        });
        if (wanted && in_.ok()) in_.keep(cells_.set_regions(data));
    }

    /// It ends with an empty line.
    void skip_metadata() {
        static_cast<void>(in_.line());
        while (in_.left() > 0 && !trimmed(in_.line()).empty()) {
        }
    }

    static constexpr std::uint64_t kMostComponents = 16;

    NumberStream in_;
    VtkCells cells_;
    bool binary_ = false;
    bool grid_ = false;
    bool has_types_ = false;
    bool has_strips_ = false;
    bool in_data_ = false;   // of points or cells, not of the dataset
    bool of_cells_ = false;  // or of points
    std::uint64_t tuples_ = 0;
};

}  // namespace

Expected<TriangleMesh> read_vtk(std::span<const std::byte> bytes, std::uint32_t max_faces) {
    return VtkFile(bytes, max_faces).read();
}

}  // namespace vsplit

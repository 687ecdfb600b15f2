#include <array>
#include <optional>
#include <string>
#include <vector>

#include "io/element_builder.h"
#include "io/number_stream.h"
#include "io/read_error.h"
#include "io/readers.h"
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
    static constexpr std::array<Known, 15> kKnown = {{{"char", Kind::kInt8},
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
        while (in_.ok() && !done_) read_part();
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
        if (!in_.more()) {
            done_ = true;
            return;
        }
        const std::string keyword = upper_case(in_.word());
        if (keyword == "POINTS") return read_points();
        if (keyword == "POLYGONS" || (grid_ && keyword == "CELLS")) return read_cells();
        if (keyword == "CELL_TYPES") return read_types();
        if (keyword == "VERTICES" || keyword == "LINES") return skip_cells();
        if (keyword == "TRIANGLE_STRIPS") return in_.fail(Cause::kUnsupported, "TRIANGLE_STRIPS are not read; POLYGONS are");
        if (keyword == "CELL_DATA") return read_cell_data();
        if (keyword == "METADATA") return skip_metadata();
        if (keyword == "FIELD") return read_field(kMost, false);
        if (keyword == "POINT_DATA") {
            done_ = !read_data_until_cells();
            return;
        }
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

    std::vector<std::int64_t> read_integers(std::uint64_t count, Kind kind, const char* what) {
        std::vector<std::int64_t> numbers;
        for (std::uint64_t i = 0; i < count && in_.ok(); ++i) {
            numbers.push_back(in_.integer(kind, what));
            cell_place_ = in_.place();
        }
        return numbers;
    }

    /// To version 4 a cell is its number of points and the points; from 5 on there are offsets and all points.
    void read_cells() {
        const std::uint64_t first = in_.count(Kind::kInt64, "the number of cells", in_.left());
        const std::uint64_t second = in_.count(Kind::kInt64, "the number of numbers", in_.left());
        if (!has_offsets()) {
            with_numbers([&] { cells_.set_legacy(read_integers(second, Kind::kInt32, "a point of a cell")); });
            if (in_.ok()) in_.keep(cells_.check_count(first, cell_place_));
            return;
        }
        std::vector<std::int64_t> offsets = read_array("OFFSETS", first);
        std::vector<std::int64_t> points = read_array("CONNECTIVITY", second);
        if (in_.ok()) in_.keep(cells_.set_offsets(offsets, std::move(points), cell_place_));
    }

    /// Whether the word OFFSETS follows: the only sign of it, as versions are often wrong.
    bool has_offsets() {
        NumberStream ahead = in_;
        return ahead.word() == "OFFSETS";
    }

    std::vector<std::int64_t> read_array(std::string_view name, std::uint64_t count) {
        in_.expect(name);
        const Kind kind = read_kind();
        std::vector<std::int64_t> numbers;
        with_numbers([&] { numbers = read_integers(count, kind, "a number of a cell"); });
        return numbers;
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
            with_numbers([&] { static_cast<void>(read_integers(second, Kind::kInt32, "a point of a cell")); });
        }
        cells_.skip_before(cells);
    }

    void read_types() {
        const std::uint64_t count = in_.count(Kind::kInt64, "the number of cells", in_.left());
        with_numbers([&] { cells_.set_types(read_integers(count, Kind::kInt32, "a cell's type")); });
    }

    void read_cell_data() {
        const std::uint64_t count = in_.count(Kind::kInt64, "the number of cells", in_.left());
        while (in_.ok() && in_.more()) {
            const std::string keyword = upper_case(in_.word());
            if (keyword == "METADATA") {
                skip_metadata();
            } else if (keyword == "SCALARS") {
                read_scalars(count);
            } else if (keyword == "FIELD") {
                read_field(count, true);
            } else {
                break;  // what else there may be (vectors, normals, data of points) is not needed
            }
        }
        done_ = true;
    }

    void read_scalars(std::uint64_t count) {
        const std::string name(in_.word());
        std::string_view rest = in_.line();
        const std::string_view type = next_word(rest);
        const std::optional<Kind> kind = kind_of(type);
        if (!kind) return in_.fail(Cause::kMalformedInput, "expected a type of numbers, " + found(type));
        const std::uint64_t components = static_cast<std::uint64_t>(parse_integer(next_word(rest)).value_or(1));
        if (components < 1 || components > 4) return in_.fail(Cause::kMalformedInput, "expected 1 to 4 components");
        in_.expect("LOOKUP_TABLE");
        static_cast<void>(in_.word());
        take_data(name, *kind, count, components);
    }

    void read_field(std::uint64_t count, bool of_cells) {
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
            const std::optional<Kind> kind = kind_of(type);
            if (!kind) return in_.fail(Cause::kUnsupported, "an array of " + quoted(type) + " is not read");
            take_data(of_cells && tuples == count ? name : "", *kind, tuples, components);
        }
    }

    void take_data(const std::string& name, Kind kind, std::uint64_t tuples, std::uint64_t components) {
        std::vector<double> values;
        const bool wanted = components == 1 && is_region_name(name);
        with_numbers([&] {
            for (std::uint64_t i = 0; i < tuples && in_.ok(); ++i) {
                for (std::uint64_t c = 0; c < components && in_.ok(); ++c) {
                    const double value = in_.number(kind, "a value of a cell");
                    if (wanted) values.push_back(value);
                }
            }
        });
        if (wanted && in_.ok()) in_.keep(cells_.set_regions(values, in_.place()));
    }

    /// It ends with an empty line.
    void skip_metadata() {
        static_cast<void>(in_.line());
        while (in_.left() > 0 && !trimmed(in_.line()).empty()) {
        }
    }

    /// Data of points may come before those of cells; of bytes nobody knows where they end without reading them.
    bool read_data_until_cells() {
        if (binary_) return false;
        while (in_.left() > 0) {
            NumberStream before = in_;
            if (!trimmed(in_.line()).starts_with("CELL_DATA")) continue;
            in_ = before;
            return true;
        }
        return false;
    }

    static constexpr std::uint64_t kMost = 0xFFFFFFFE;

    NumberStream in_;
    VtkCells cells_;
    Place cell_place_ = at_line(1);
    bool binary_ = false;
    bool grid_ = false;
    bool done_ = false;
};

}  // namespace

Expected<TriangleMesh> read_vtk(std::span<const std::byte> bytes, std::uint32_t max_faces) {
    return VtkFile(bytes, max_faces).read();
}

}  // namespace vsplit

#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "io/element_builder.h"
#include "io/read_error.h"
#include "vsplit/base/expected.h"

namespace vsplit {

/// Where a number of an array stands, by its index. Asked for messages alone, so that it may read all before it again.
using PlaceOf = std::function<Place(std::size_t)>;

/// Numbers of an array and where they stand.
template <class Number>
struct PlacedNumbers {
    std::vector<Number> values;
    PlaceOf place_of;
};

/// Points and cells as both of VTK's formats have them, made a mesh.
class VtkCells {
public:
    static constexpr std::int64_t kStrip = 6;
    static constexpr std::int64_t kPolygon = 7;

    explicit VtkCells(std::uint32_t max_faces) : builder_(max_faces) {}

    /// \return INVALID_COORDINATE, LIMIT_EXCEEDED.
    [[nodiscard]] Status add_point(const Vec3& point, Place place);

    /// Cells as runs of a count and points, all of `type` unless set_types says what they are.
    /// \return MALFORMED_INPUT when the runs are not `cells`, or a run ends beyond the others.
    [[nodiscard]] Status add_runs(const PlacedNumbers<std::int64_t>& runs, std::uint64_t cells, std::int64_t type);

    /// Cells as where each ends among `points`. \return MALFORMED_INPUT when they run backwards or end elsewhere than the points.
    [[nodiscard]] Status add_ends(std::span<const std::int64_t> ends, const PlaceOf& place_of_end,
                                  const PlacedNumbers<std::int64_t>& points, std::int64_t type);

    void set_types(PlacedNumbers<std::int64_t> types) { types_ = std::move(types); }

    /// Cells that come before the others in the cells' data and are no faces.
    void skip_before(std::uint64_t cells) { before_ += cells; }

    /// \return MALFORMED_INPUT for a value that is no region, or for fewer or more than cells.
    [[nodiscard]] Status set_regions(const PlacedNumbers<double>& values);

    [[nodiscard]] std::uint64_t point_count() const { return points_seen_; }
    [[nodiscard]] std::uint64_t cell_count() const { return cells_.size(); }

    /// \return what ElementBuilder::take returns; MALFORMED_INPUT; INDEX_OUT_OF_RANGE; UNSUPPORTED for cells of an unknown type.
    [[nodiscard]] Expected<TriangleMesh> take();

private:
    struct Cell {
        std::size_t begin = 0;  // in points_
        std::size_t end = 0;
    };
    struct Array {
        std::size_t first_cell = 0;
        std::size_t first_point = 0;
        bool has_counts = false;  // a cell's number of points before them
        std::int64_t type = kPolygon;
        PlaceOf place_of;
    };

    [[nodiscard]] const Array& array_of(std::size_t cell) const;
    [[nodiscard]] Place place_of(std::size_t cell, std::size_t corner) const;
    [[nodiscard]] Place place_of_cell(std::size_t cell) const;
    [[nodiscard]] Status add_cell(std::size_t cell);
    [[nodiscard]] Status check_points(std::size_t cell) const;
    [[nodiscard]] Status add_face(std::size_t cell, std::span<const std::int64_t> corners);
    [[nodiscard]] Status add_strip(std::size_t cell, std::span<const std::int64_t> points);

    ElementBuilder builder_;
    std::uint64_t points_seen_ = 0;
    std::vector<Array> arrays_;
    std::vector<std::int64_t> points_;
    std::vector<Cell> cells_;
    std::optional<PlacedNumbers<std::int64_t>> types_;
    std::vector<std::uint32_t> regions_;
    std::uint64_t before_ = 0;
    std::int64_t faces_ = 0;
};

}  // namespace vsplit

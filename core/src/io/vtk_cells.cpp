#include "io/vtk_cells.h"

#include <algorithm>
#include <array>
#include <utility>

#include "io/region_value.h"

namespace vsplit {
namespace {

constexpr std::int64_t kPixel = 8;

enum class Kind { kFace, kStrip, kNoFace, kSolid, kUnknown };

/// A type of VTK's cells.
struct CellType {
    Kind kind = Kind::kUnknown;
    std::size_t corners = 0;  ///< the first points of a face; 0: all
    std::size_t points = 0;   ///< that it has; 0: as many as corners or more
};

CellType type_of(std::int64_t number) {
    switch (number) {
        case 0:  // empty, vertex, poly-vertex, line, poly-line, quadratic edge
        case 1:
        case 2:
        case 3:
        case 4:
        case 21:
            return {Kind::kNoFace, 0, 0};
        case 5:
            return {Kind::kFace, 3, 3};
        case VtkCells::kStrip:
            return {Kind::kStrip, 3, 0};
        case VtkCells::kPolygon:
            return {Kind::kFace, 0, 0};
        case kPixel:
        case 9:
            return {Kind::kFace, 4, 4};
        case 22:  // triangles of second order: without a node in the middle and with one
            return {Kind::kFace, 3, 6};
        case 34:
            return {Kind::kFace, 3, 7};
        case 69:  // of any order
            return {Kind::kFace, 3, 0};
        case 23:  // quadrilaterals of second order: the same, and with straight sides
            return {Kind::kFace, 4, 8};
        case 28:
            return {Kind::kFace, 4, 9};
        case 30:
            return {Kind::kFace, 4, 6};
        case 70:
            return {Kind::kFace, 4, 0};
        default:
            return {number >= 10 && number <= 33 ? Kind::kSolid : Kind::kUnknown, 0, 0};
    }
}

}  // namespace

Status VtkCells::add_point(const Vec3& point, Place place) {
    return builder_.add_node(static_cast<std::int64_t>(points_seen_++), point, place);
}

Status VtkCells::add_runs(const PlacedNumbers<std::int64_t>& runs, std::uint64_t cells, std::int64_t type) {
    const std::vector<std::int64_t>& numbers = runs.values;
    const std::size_t first = cells_.size();
    arrays_.push_back({first, points_.size(), true, type, runs.place_of});
    for (std::size_t at = 0; at < numbers.size();) {
        const std::int64_t count = numbers[at];
        if (count < 0 || static_cast<std::uint64_t>(count) > numbers.size() - at - 1) {
            return read_error(Cause::kMalformedInput, runs.place_of(at),
                              "cell " + std::to_string(cells_.size()) + " is to have " + std::to_string(count) + " points, but " +
                                  std::to_string(numbers.size() - at - 1) + " numbers follow");
        }
        const std::size_t begin = points_.size();
        const auto from = numbers.begin() + static_cast<std::ptrdiff_t>(at) + 1;
        points_.insert(points_.end(), from, from + count);
        cells_.push_back({begin, points_.size()});
        at += static_cast<std::size_t>(count) + 1;
    }
    if (cells_.size() - first == cells) return Done{};
    return read_error(
        Cause::kMalformedInput, runs.place_of(numbers.empty() ? 0 : numbers.size() - 1),
        std::to_string(cells) + " cells are announced, but the numbers make " + std::to_string(cells_.size() - first));
}

Status VtkCells::add_ends(std::span<const std::int64_t> ends, const PlaceOf& place_of_end,
                          const PlacedNumbers<std::int64_t>& points, std::int64_t type) {
    const std::size_t base = points_.size();
    const auto count = static_cast<std::int64_t>(points.values.size());
    arrays_.push_back({cells_.size(), base, false, type, points.place_of});
    points_.insert(points_.end(), points.values.begin(), points.values.end());
    std::int64_t begin = 0;
    for (std::size_t i = 0; i < ends.size(); ++i) {
        const bool is_last = i + 1 == ends.size();
        if (ends[i] < begin || ends[i] > count || (is_last && ends[i] != count)) {
            return read_error(Cause::kMalformedInput, place_of_end(i),
                              "cell " + std::to_string(cells_.size()) + " begins at " + std::to_string(begin) + " of " +
                                  std::to_string(count) + " points and ends at " + std::to_string(ends[i]) +
                                  (is_last ? "; the last one must end where the points do" : ""));
        }
        cells_.push_back({base + static_cast<std::size_t>(begin), base + static_cast<std::size_t>(ends[i])});
        begin = ends[i];
    }
    if (!ends.empty() || count == 0) return Done{};
    return read_error(Cause::kMalformedInput, points.place_of(0),
                      std::to_string(count) + " points of cells are given, but no cell ends");
}

Status VtkCells::set_regions(const PlacedNumbers<double>& values) {
    const std::size_t first = std::min<std::size_t>(before_, values.values.size());
    regions_.clear();
    for (std::size_t i = first; i < values.values.size(); ++i) {
        const Expected<std::uint32_t> region = region_of(values.values[i], at_line(1));
        if (!region) return region_of(values.values[i], values.place_of(i)).error();
        regions_.push_back(*region);
    }
    if (values.values.size() == before_ + cells_.size()) return Done{};
    return read_error(
        Cause::kMalformedInput, values.place_of(0),
        std::to_string(values.values.size()) + " regions are given for " + std::to_string(before_ + cells_.size()) + " cells");
}

const VtkCells::Array& VtkCells::array_of(std::size_t cell) const {
    auto after = std::find_if(arrays_.begin(), arrays_.end(), [cell](const Array& array) { return array.first_cell > cell; });
    return *std::prev(after);
}

Place VtkCells::place_of(std::size_t cell, std::size_t corner) const {
    const Array& array = array_of(cell);
    const std::size_t counts = array.has_counts ? cell - array.first_cell + 1 : 0;
    return array.place_of(cells_[cell].begin - array.first_point + counts + corner);
}

Place VtkCells::place_of_cell(std::size_t cell) const {
    const Array& array = array_of(cell);
    return array.place_of(cells_[cell].begin - array.first_point + (array.has_counts ? cell - array.first_cell : 0));
}

Status VtkCells::check_points(std::size_t cell) const {
    const auto& [begin, end] = cells_[cell];
    for (std::size_t i = begin; i < end; ++i) {
        if (points_[i] >= 0 && static_cast<std::uint64_t>(points_[i]) < points_seen_) continue;
        const std::string there = points_seen_ == 0 ? "there are none" : "there are 0 to " + std::to_string(points_seen_ - 1);
        return read_error(Cause::kIndexOutOfRange, place_of(cell, i - begin),
                          "cell " + std::to_string(cell) + " names point " + std::to_string(points_[i]) + "; " + there);
    }
    return Done{};
}

Status VtkCells::add_face(std::size_t cell, std::span<const std::int64_t> corners) {
    const std::uint32_t region = regions_.empty() ? 0 : regions_[cell];
    if (Status added = builder_.add_element(faces_++, corners, at_line(1), region)) return added;
    return builder_.add_element(faces_, corners, place_of_cell(cell), region);  // for the place, which takes a search
}

/// Each point from the third on makes a triangle with the two before it, every second one turned.
Status VtkCells::add_strip(std::size_t cell, std::span<const std::int64_t> points) {
    for (std::size_t i = 2; i < points.size(); ++i) {
        std::array<std::int64_t, 3> corners = {points[i - 2], points[i - 1], points[i]};
        if (i % 2 != 0) std::swap(corners[0], corners[1]);
        if (Status added = add_face(cell, corners); !added) return added;
    }
    return Done{};
}

Status VtkCells::add_cell(std::size_t cell) {
    const auto& [begin, end] = cells_[cell];
    const std::size_t count = end - begin;
    const std::int64_t number = types_ ? types_->values[cell] : array_of(cell).type;
    const CellType type = type_of(number);
    if (type.kind == Kind::kUnknown) {
        return read_error(Cause::kUnsupported, types_->place_of(cell),
                          "cell " + std::to_string(cell) + " is of type " + std::to_string(number) + ", which is not read");
    }
    if (type.kind == Kind::kSolid) builder_.skip_solid();
    if (type.kind == Kind::kSolid || type.kind == Kind::kNoFace) return Done{};
    const std::size_t least = std::max<std::size_t>(3, type.corners);
    if (type.points != 0 ? count != type.points : count < least) {
        return read_error(Cause::kMalformedInput, place_of_cell(cell),
                          "cell " + std::to_string(cell) + " of type " + std::to_string(number) + " has " +
                              std::to_string(count) + " points; expected " +
                              (type.points != 0 ? std::to_string(type.points) : std::to_string(least) + " or more"));
    }
    if (Status there = check_points(cell); !there) return there;
    const auto points = std::span<const std::int64_t>(points_).subspan(begin, type.corners == 0 ? count : type.corners);
    if (type.kind == Kind::kStrip) return add_strip(cell, std::span<const std::int64_t>(points_).subspan(begin, count));
    if (number != kPixel) return add_face(cell, points);
    return add_face(cell, std::array{points[0], points[1], points[3], points[2]});  // a pixel's go row by row
}

Expected<TriangleMesh> VtkCells::take() {
    if (types_ && types_->values.size() != cells_.size()) {
        return read_error(
            Cause::kMalformedInput, types_->place_of(0),
            std::to_string(types_->values.size()) + " types are given for " + std::to_string(cells_.size()) + " cells");
    }
    for (std::size_t cell = 0; cell < cells_.size(); ++cell) {
        if (Status added = add_cell(cell); !added) return added.error();
    }
    return builder_.take();
}

}  // namespace vsplit

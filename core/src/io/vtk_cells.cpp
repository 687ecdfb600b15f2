#include "io/vtk_cells.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "io/text_lines.h"

namespace vsplit {
namespace {

/// Corners of a cell that is a face, 0 for one that is none, of VTK's types; -1: a solid; -2: unknown.
int corners_of(std::int64_t type, std::size_t points) {
    switch (type) {
        case 1:  // vertex, poly-vertex, line, poly-line, quadratic edge
        case 2:
        case 3:
        case 4:
        case 21:
            return 0;
        case 5:  // triangle, quadratic triangle, and with a node in the middle
        case 22:
        case 34:
        case 69:
            return 3;
        case 9:  // quad, quadratic quads
        case 23:
        case 28:
        case 30:
        case 70:
            return 4;
        case 7:  // polygon
            return static_cast<int>(std::min<std::size_t>(points, 1U << 30U));
        default:
            return type >= 10 && type <= 33 ? -1 : -2;
    }
}

constexpr std::int64_t kPolygon = 7;

}  // namespace

bool is_region_name(std::string_view name) {
    constexpr std::array<std::string_view, 14> kNames = {
        "region", "regions",       "region_id",     "regionid",    "group",       "group_id", "physicalids",
        "label",  "gmsh:physical", "cellentityids", "material_id", "materialids", "face_id",  "pid"};
    return std::any_of(kNames.begin(), kNames.end(), [&](std::string_view known) { return equals_ignoring_case(known, name); });
}

Status VtkCells::add_point(const Vec3& point, Place place) { return builder_.add_node(points_seen_++, point, place); }

Status VtkCells::check_count(std::uint64_t cells, Place place) {
    place_ = place;
    for (std::size_t at = 0; at < legacy_.size();) {
        const std::int64_t count = legacy_[at];
        if (count < 0 || static_cast<std::uint64_t>(count) > legacy_.size() - at - 1) {
            return read_error(Cause::kMalformedInput, place,
                              "cell " + std::to_string(cells_.size()) + " is to have " + std::to_string(count) + " points, but " +
                                  std::to_string(legacy_.size() - at - 1) + " numbers follow");
        }
        const std::size_t begin = points_.size();
        points_.insert(points_.end(), legacy_.begin() + static_cast<std::ptrdiff_t>(at) + 1,
                       legacy_.begin() + static_cast<std::ptrdiff_t>(at) + 1 + count);
        cells_.push_back({begin, points_.size()});
        at += static_cast<std::size_t>(count) + 1;
    }
    legacy_.clear();
    if (cells_.size() == cells) return Done{};
    return read_error(Cause::kMalformedInput, place,
                      std::to_string(cells) + " cells are announced, but the numbers make " + std::to_string(cells_.size()));
}

Status VtkCells::set_offsets(const std::vector<std::int64_t>& offsets, std::vector<std::int64_t> points, Place place) {
    place_ = place;
    points_ = std::move(points);
    std::size_t begin = 0;
    for (std::size_t i = 0; i < offsets.size(); ++i) {
        const std::int64_t end = offsets[i];
        if (i == 0 && end == 0) continue;
        if (end < static_cast<std::int64_t>(begin) || end > static_cast<std::int64_t>(points_.size())) {
            return read_error(Cause::kMalformedInput, place,
                              "cell " + std::to_string(cells_.size()) + " ends at " + std::to_string(end) + " of " +
                                  std::to_string(points_.size()) + " points and begins at " + std::to_string(begin));
        }
        cells_.push_back({begin, static_cast<std::size_t>(end)});
        begin = static_cast<std::size_t>(end);
    }
    return Done{};
}

Status VtkCells::set_regions(const std::vector<double>& values, Place place) {
    constexpr double kLargest = 4294967294;
    if (values.size() != before_ + cells_.size()) {
        return read_error(
            Cause::kMalformedInput, place,
            std::to_string(values.size()) + " values are given for " + std::to_string(before_ + cells_.size()) + " cells");
    }
    regions_.clear();
    for (std::size_t i = before_; i < values.size(); ++i) {
        if (!(values[i] >= 0 && values[i] <= kLargest && values[i] == std::trunc(values[i]))) {
            return read_error(Cause::kMalformedInput, place,
                              "expected a cell's region, an integer from 0 to 4294967294, found " + to_text(values[i]));
        }
        regions_.push_back(static_cast<std::uint32_t>(values[i]));
    }
    return Done{};
}

Status VtkCells::add_cell(std::size_t number) {
    const auto& [begin, end] = cells_[number];
    const std::int64_t type = types_.empty() ? kPolygon : types_[number];
    const int corners = corners_of(type, end - begin);
    if (corners == -2) {
        return read_error(Cause::kUnsupported, place_,
                          "cell " + std::to_string(number) + " is of type " + std::to_string(type) + ", which is not read");
    }
    if (corners == -1) builder_.skip_solid();
    if (corners == -1 || (corners == 0 && type != kPolygon)) return Done{};
    if (corners < 3 || end - begin < static_cast<std::size_t>(corners)) {
        return read_error(Cause::kMalformedInput, place_,
                          "cell " + std::to_string(number) + " has " + std::to_string(end - begin) + " points; expected " +
                              std::to_string(std::max(3, corners)));
    }
    return builder_.add_element(static_cast<std::int64_t>(number),
                                std::span(points_).subspan(begin, static_cast<std::size_t>(corners)), place_,
                                regions_.empty() ? 0 : regions_[number]);
}

Expected<TriangleMesh> VtkCells::take() {
    if (!types_.empty() && types_.size() != cells_.size()) {
        return read_error(Cause::kMalformedInput, place_,
                          std::to_string(types_.size()) + " types are given for " + std::to_string(cells_.size()) + " cells");
    }
    for (std::size_t number = 0; number < cells_.size(); ++number) {
        if (Status added = add_cell(number); !added) return added.error();
    }
    return builder_.take();
}

}  // namespace vsplit

#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "io/element_builder.h"
#include "vsplit/base/expected.h"

namespace vsplit {

/// Whether an array of this name, of cells or faces, says which region each is in: "region", "regions", "region_id", "group",
/// "PhysicalIds", "gmsh:physical", "CellEntityIds", "label", "material" and the like, in any case.
[[nodiscard]] bool is_region_name(std::string_view name);

/// Points and cells as both of VTK's formats have them, made a mesh.
class VtkCells {
public:
    explicit VtkCells(std::uint32_t max_faces) : builder_(max_faces) {}

    /// \return INVALID_COORDINATE.
    [[nodiscard]] Status add_point(const Vec3& point, Place place);

    /// Cells as runs of a count and points, polygons unless set_types says what they are.
    void set_legacy(std::vector<std::int64_t> numbers) { legacy_ = std::move(numbers); }
    /// MALFORMED_INPUT when the runs are not as many, or a run ends beyond the others.
    [[nodiscard]] Status check_count(std::uint64_t cells, Place place);

    /// Cells as where each ends among the points (with a 0 in front, or without).
    [[nodiscard]] Status set_offsets(const std::vector<std::int64_t>& offsets, std::vector<std::int64_t> points, Place place);

    void set_types(std::vector<std::int64_t> types) { types_ = std::move(types); }

    /// Cells that come before the others in the cells' data and are no faces.
    void skip_before(std::uint64_t cells) { before_ += cells; }

    /// \return MALFORMED_INPUT for a value that is no integer from 0 to 2^32 - 2, or for fewer or more than cells.
    [[nodiscard]] Status set_regions(const std::vector<double>& values, Place place);

    /// \return what ElementBuilder::take returns; MALFORMED_INPUT; UNSUPPORTED for cells of an unknown type.
    [[nodiscard]] Expected<TriangleMesh> take();

private:
    struct Cell {
        std::size_t begin = 0;  // in points_
        std::size_t end = 0;
    };

    [[nodiscard]] Status add_cell(std::size_t number);

    ElementBuilder builder_;
    std::int64_t points_seen_ = 0;
    std::vector<std::int64_t> legacy_;
    std::vector<std::int64_t> points_;
    std::vector<Cell> cells_;
    std::vector<std::int64_t> types_;
    std::vector<std::uint32_t> regions_;
    std::uint64_t before_ = 0;
    Place place_ = at_line(1);
};

}  // namespace vsplit

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "io/mesh_builder.h"
#include "io/ply_body.h"
#include "io/ply_header.h"
#include "io/read_error.h"
#include "io/readers.h"
#include "io/region_value.h"
#include "io/text_lines.h"

namespace vsplit {
namespace {

/// Where in a vertex's row its coordinates are.
struct PositionProperties {
    std::array<std::size_t, 3> at{};
};

Expected<PositionProperties> find_position(const PlyElement& vertex) {
    PositionProperties position;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::string_view name = std::string_view("xyz").substr(axis, 1);
        const auto found = std::find_if(vertex.properties.begin(), vertex.properties.end(),
                                        [&](const PlyProperty& property) { return property.name == name && !property.is_list; });
        if (found == vertex.properties.end()) {
            return read_error(Cause::kMalformedInput, at_line(vertex.line),
                              "element 'vertex' needs the properties x, y and z; " + quoted(name) + " is missing");
        }
        position.at[axis] = static_cast<std::size_t>(found - vertex.properties.begin());
    }
    return position;
}

/// Where in a face's row its corners are.
Expected<std::size_t> find_corners(const PlyElement& face) {
    const auto is_corners = [](const PlyProperty& property) {
        return property.is_list && is_integer(property.type) &&
               (property.name == "vertex_indices" || property.name == "vertex_index");
    };
    const auto found = std::find_if(face.properties.begin(), face.properties.end(), is_corners);
    if (found != face.properties.end()) return static_cast<std::size_t>(found - face.properties.begin());
    return read_error(Cause::kMalformedInput, at_line(face.line),
                      "element 'face' needs a list of integers named 'vertex_indices' or 'vertex_index'");
}

template <class Body>
class PlyReader {
public:
    PlyReader(const PlyHeader& header, Body body, std::uint32_t max_faces) : header_(header), body_(body), builder_(max_faces) {}

    Expected<TriangleMesh> read() {
        for (const PlyElement& element : header_.elements) {
            if (element.name == "vertex") vertices_ = element.count;
        }
        for (const PlyElement& element : header_.elements) {
            if (const Status status = read_element(element); !status) return status.error();
        }
        if (const Status status = body_.end_file(); !status) return status.error();
        Expected<TriangleMesh> mesh = builder_.take();
        const bool some = std::any_of(regions_.begin(), regions_.end(), [](std::uint32_t region) { return region != 0; });
        if (mesh && some) mesh->regions = std::move(regions_);
        return mesh;
    }

private:
    Status read_element(const PlyElement& element) {
        if (element.properties.empty()) return Done{};  // its rows are of no bytes
        const std::size_t least = element.least_bytes(header_.encoding);
        const Status fits = check_announced(element.name + " rows", element.count, least, body_.left(), at_line(element.line));
        if (!fits) return fits.error();
        if (element.name == "vertex") return read_vertices(element);
        if (element.name == "face") return read_faces(element);
        if (element.name == "tristrips" && element.count > 0)
            return read_error(Cause::kUnsupported, at_line(element.line), "triangle strips are not read; element 'face' is");
        return read_rows(element, [&](const PlyProperty& property, std::size_t) { return skip(property); });
    }

    /// Calls `read_property(property, its number)` for each property of each row.
    template <class ReadProperty>
    Status read_rows(const PlyElement& element, ReadProperty read_property) {
        for (std::uint64_t row = 0; row < element.count; ++row) {
            if (const Status status = body_.begin_row(); !status) return status.error();
            for (std::size_t i = 0; i < element.properties.size(); ++i) {
                if (const Status status = read_property(element.properties[i], i); !status) return status.error();
            }
            if (const Status status = body_.end_row(); !status) return status.error();
        }
        return Done{};
    }

    Status read_vertices(const PlyElement& element) {
        const Expected<PositionProperties> at = find_position(element);
        if (!at) return at.error();
        const Status reserved = builder_.reserve(element.count, 0, at_line(element.line));
        if (!reserved) return reserved.error();
        Vec3 position;
        const std::size_t last = element.properties.size() - 1;
        return read_rows(element, [&](const PlyProperty& property, std::size_t number) -> Status {
            const Place place = body_.place();
            const auto* const axis = std::find(at->at.begin(), at->at.end(), number);
            if (axis == at->at.end()) {
                if (const Status status = skip(property); !status) return status.error();
            } else {
                const Expected<double> value = body_.read(property.type);
                if (!value) return value.error();
                if (!is_valid_coordinate(*value))
                    return coordinate_error(static_cast<std::size_t>(axis - at->at.begin()), *value, place);
                position[axis - at->at.begin()] = *value;
            }
            return number == last ? builder_.add_vertex(position, place) : Done{};
        });
    }

    Status read_faces(const PlyElement& element) {
        const Expected<std::size_t> corners = find_corners(element);
        if (!corners) return corners.error();
        const Status reserved = builder_.reserve(vertices_, element.count, at_line(element.line));
        if (!reserved) return reserved.error();
        const std::size_t region = find_region(element);
        const std::size_t last = element.properties.size() - 1;
        return read_rows(element, [&](const PlyProperty& property, std::size_t number) -> Status {
            Status read = number == region ? read_region(property) : number == *corners ? read_polygon(property) : skip(property);
            if (number == last && region <= last) regions_.resize(builder_.face_count(), region_);
            return read;
        });
    }

    /// The number of the property that says which region a face is in; beyond all where there is none.
    static std::size_t find_region(const PlyElement& face) {
        const auto found = std::find_if(face.properties.begin(), face.properties.end(), [](const PlyProperty& property) {
            return !property.is_list && is_region_name(property.name);
        });
        return static_cast<std::size_t>(found - face.properties.begin());
    }

    Status read_region(const PlyProperty& property) {
        const Place place = body_.place();
        const Expected<double> value = body_.read(property.type);
        if (!value) return value.error();
        const Expected<std::uint32_t> region = region_of(*value, place);
        if (!region) return region.error();
        region_ = *region;
        return Done{};
    }

    Status read_polygon(const PlyProperty& property) {
        const Place place = body_.place();
        const Expected<std::uint64_t> count = read_length(property);
        if (!count) return count.error();
        corners_.clear();
        for (std::uint64_t i = 0; i < *count; ++i) {
            const Expected<double> index = body_.read(property.type);
            if (!index) return index.error();
            if (!(*index >= 0 && *index < static_cast<double>(vertices_))) {
                return index_error(to_integer(*index), vertices_, place);
            }
            corners_.push_back(static_cast<std::uint32_t>(*index));
        }
        return builder_.add_polygon(corners_, place);
    }

    Expected<std::uint64_t> read_length(const PlyProperty& list) {
        const Place place = body_.place();
        const Expected<double> length = body_.read(list.count_type);
        if (!length) return length.error();
        constexpr double kLongest = 4294967295;  // what the widest type can say
        if (*length >= 0 && *length <= kLongest) return static_cast<std::uint64_t>(*length);
        return read_error(Cause::kMalformedInput, place, "a list has the length " + to_text(*length));
    }

    Status skip(const PlyProperty& property) {
        if (!property.is_list) return body_.skip(property.type, 1);
        const Expected<std::uint64_t> length = read_length(property);
        if (!length) return length.error();
        return body_.skip(property.type, *length);
    }

    /// For a message: text may name integers that no integer type holds.
    static std::int64_t to_integer(double value) {
        constexpr double kLargest = 9e18;
        return static_cast<std::int64_t>(std::clamp(value, -kLargest, kLargest));
    }

    const PlyHeader& header_;
    Body body_;
    MeshBuilder builder_;
    std::uint64_t vertices_ = 0;
    std::vector<std::uint32_t> corners_;
    std::vector<std::uint32_t> regions_;
    std::uint32_t region_ = 0;  // of the row
};

}  // namespace

Expected<TriangleMesh> read_ply(std::span<const std::byte> bytes, std::uint32_t max_faces) {
    const Expected<PlyHeader> header = parse_ply_header(as_text(bytes));
    if (!header) return header.error();
    if (header->encoding == PlyEncoding::kAscii) return PlyReader(*header, PlyTextBody(bytes, *header), max_faces).read();
    return PlyReader(*header, PlyBinaryBody(bytes, *header), max_faces).read();
}

}  // namespace vsplit

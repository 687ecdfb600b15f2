#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>

#include "io/elements.h"
#include "io/number_writer.h"
#include "io/writers.h"

namespace vsplit {
namespace {

/// The bytes as text of base64 (RFC 4648).
std::string base64(const std::string& bytes) {
    constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const std::size_t left = std::min<std::size_t>(3, bytes.size() - i);
        std::uint32_t bits = 0;
        for (std::size_t k = 0; k < 3; ++k) bits = bits << 8U | (k < left ? static_cast<std::uint8_t>(bytes[i + k]) : 0U);
        for (std::size_t k = 0; k < 4; ++k) text += k <= left ? kDigits[bits >> (18 - 6 * k) & 63U] : '=';
    }
    return text;
}

/// An array, whose numbers `put(writer)` writes, behind its length. As base64 in its tag: appended bytes are shorter, but one
/// reader that people use, meshio, finds no arrays whose offsets are alike in bytes and in base64, as those of a closed surface
/// are.
template <class Put>
std::string array(std::string_view type, std::string_view name, std::string_view components, std::uint64_t bytes, Put put) {
    NumberWriter numbers(NumberWriter::As::kLittleEndian);
    numbers.put(bytes);
    put(numbers);
    std::string tag = "        <DataArray type=\"";
    tag.append(type).append("\" Name=\"").append(name).append("\" NumberOfComponents=\"").append(components);
    return tag.append("\" format=\"binary\">\n").append(base64(numbers.take())).append("\n        </DataArray>\n");
}

}  // namespace

std::string write_vtu(const Elements& elements) {
    const TriangleMesh& mesh = elements.mesh();
    const std::uint32_t nodes = elements.order_nodes();
    const std::size_t points = elements.node_count();
    const std::uint64_t faces = mesh.faces.size();
    std::string text =
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" "
        "header_type=\"UInt64\">\n  <UnstructuredGrid>\n    <Piece NumberOfPoints=\"";
    text.append(std::to_string(points)).append("\" NumberOfCells=\"").append(std::to_string(faces)).append("\">\n");
    text += "      <Points>\n" +
            array("Float64", "Points", "3", 24 * points,
                  [&](NumberWriter& out) {
                      for (std::size_t node = 0; node < points; ++node) out.put(elements.position(node));
                  }) +
            "      </Points>\n      <Cells>\n";
    text += array("UInt32", "connectivity", "1", std::size_t{4} * nodes * faces, [&](NumberWriter& out) {
        for (std::uint64_t f = 0; f < faces; ++f) {
            for (std::uint32_t i = 0; i < nodes; ++i) out.put(elements.node(f, i));
        }
    });
    text += array("Int64", "offsets", "1", 8 * faces, [&](NumberWriter& out) {
        for (std::uint64_t f = 1; f <= faces; ++f) out.put(static_cast<std::int64_t>(nodes * f));
    });
    const std::uint8_t type = nodes == 3 ? 5 : 22;
    text += array("UInt8", "types", "1", faces, [&](NumberWriter& out) {
        for (std::uint64_t f = 0; f < faces; ++f) out.put(type);
    });
    text += "      </Cells>\n";
    if (!mesh.regions.empty()) {
        text += "      <CellData Scalars=\"region\">\n" +
                array("UInt32", "region", "1", 4 * faces,
                      [&](NumberWriter& out) {
                          for (const std::uint32_t region : mesh.regions) out.put(region);
                      }) +
                "      </CellData>\n";
    }
    return text + "    </Piece>\n  </UnstructuredGrid>\n</VTKFile>\n";
}

}  // namespace vsplit

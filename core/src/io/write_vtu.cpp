#include "io/elements.h"
#include "io/number_writer.h"
#include "io/writers.h"

namespace vsplit {
namespace {

/// Arrays stand as bytes behind the tags, each with its length in front.
class Arrays {
public:
    Arrays() : bytes_(NumberWriter::As::kLittleEndian) {}

    /// The tag of an array, whose numbers `put(writer)` writes.
    template <class Put>
    std::string add(std::string_view type, std::string_view name, std::string_view components, std::uint64_t bytes, Put put) {
        std::string tag = "        <DataArray type=\"";
        tag.append(type).append("\" Name=\"").append(name).append("\" NumberOfComponents=\"").append(components);
        tag.append("\" format=\"appended\" offset=\"").append(std::to_string(size_)).append("\"/>\n");
        bytes_.put(bytes);
        put(bytes_);
        size_ += sizeof(std::uint64_t) + bytes;
        return tag;
    }

    [[nodiscard]] std::string take() { return bytes_.take(); }

private:
    NumberWriter bytes_;
    std::uint64_t size_ = 0;
};

}  // namespace

std::string write_vtu(const Elements& elements) {
    const TriangleMesh& mesh = elements.mesh();
    const std::uint32_t nodes = elements.order_nodes();
    const std::size_t points = elements.node_count();
    const std::uint64_t faces = mesh.faces.size();
    Arrays arrays;
    std::string text =
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" "
        "header_type=\"UInt64\">\n  <UnstructuredGrid>\n    <Piece NumberOfPoints=\"";
    text.append(std::to_string(points)).append("\" NumberOfCells=\"").append(std::to_string(faces)).append("\">\n");
    text += "      <Points>\n" + arrays.add("Float64", "Points", "3", 24 * points, [&](NumberWriter& out) {
        for (std::size_t node = 0; node < points; ++node) out.put(elements.position(node));
    }) + "      </Points>\n      <Cells>\n";
    text += arrays.add("UInt32", "connectivity", "1", std::size_t{4} * nodes * faces, [&](NumberWriter& out) {
        for (std::uint64_t f = 0; f < faces; ++f) {
            for (std::uint32_t i = 0; i < nodes; ++i) out.put(elements.node(f, i));
        }
    });
    text += arrays.add("Int64", "offsets", "1", 8 * faces, [&](NumberWriter& out) {
        for (std::uint64_t f = 1; f <= faces; ++f) out.put(static_cast<std::int64_t>(nodes * f));
    });
    const std::uint8_t type = nodes == 3 ? 5 : 22;
    text += arrays.add("UInt8", "types", "1", faces, [&](NumberWriter& out) {
        for (std::uint64_t f = 0; f < faces; ++f) out.put(type);
    });
    text += "      </Cells>\n";
    if (!mesh.regions.empty()) {
        text += "      <CellData Scalars=\"region\">\n" + arrays.add("UInt32", "region", "1", 4 * faces, [&](NumberWriter& out) {
            for (const std::uint32_t region : mesh.regions) out.put(region);
        }) + "      </CellData>\n";
    }
    text += "    </Piece>\n  </UnstructuredGrid>\n  <AppendedData encoding=\"raw\">\n   _";
    return text + arrays.take() + "\n  </AppendedData>\n</VTKFile>\n";
}

}  // namespace vsplit

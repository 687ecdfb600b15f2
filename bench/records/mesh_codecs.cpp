#include "records/mesh_codecs.h"

#include <draco/compression/decode.h>
#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <meshoptimizer.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <vector>

namespace vsplit::bench {
namespace {

constexpr int kBits = 14;

void require(bool done, const char* what) {
    if (done) return;
    std::fprintf(stderr, "%s failed\n", what);
    std::exit(1);
}

/// What meshoptimizer's buffers leave to the program that uses them.
struct Front {
    std::uint32_t vertices = 0, faces = 0;
    std::uint64_t vertex_bytes = 0;
    double origin[3] = {}, step = 0;
};

struct GridVertex {
    std::uint16_t xyz[4];  // the codec wants multiples of 4 bytes
};

const unsigned char* bytes_of(std::string_view text) { return reinterpret_cast<const unsigned char*>(text.data()); }

}  // namespace

std::string encode_draco(const TriangleMesh& mesh) {
    draco::TriangleSoupMeshBuilder builder;
    builder.Start(static_cast<int>(mesh.face_count()));
    const int position = builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
        float corners[3][3];
        for (int c = 0; c < 3; ++c) {
            for (int axis = 0; axis < 3; ++axis) corners[c][axis] = static_cast<float>(mesh.positions[mesh.faces[f][c]][axis]);
        }
        builder.SetAttributeValuesForFace(position, draco::FaceIndex(f), corners[0], corners[1], corners[2]);
    }
    draco::Encoder encoder;
    encoder.SetAttributeQuantization(draco::GeometryAttribute::POSITION, kBits);
    draco::EncoderBuffer buffer;
    require(encoder.EncodeMeshToBuffer(*builder.Finalize(), &buffer).ok(), "Draco's encoder");
    return {buffer.data(), buffer.size()};
}

TriangleMesh decode_draco(std::string_view bytes) {
    draco::DecoderBuffer buffer;
    buffer.Init(bytes.data(), bytes.size());
    auto decoded = draco::Decoder().DecodeMeshFromBuffer(&buffer);
    require(decoded.ok(), "Draco's decoder");
    const std::unique_ptr<draco::Mesh> from = std::move(decoded).value();
    const draco::PointAttribute& positions = *from->GetNamedAttribute(draco::GeometryAttribute::POSITION);
    TriangleMesh mesh;
    mesh.positions.reserve(from->num_points());
    for (draco::PointIndex p(0); p < from->num_points(); ++p) {
        float xyz[3];
        positions.GetMappedValue(p, xyz);
        mesh.positions.emplace_back(xyz[0], xyz[1], xyz[2]);
    }
    mesh.faces.reserve(from->num_faces());
    for (draco::FaceIndex f(0); f < from->num_faces(); ++f) {
        const draco::Mesh::Face& face = from->face(f);
        mesh.faces.push_back({face[0].value(), face[1].value(), face[2].value()});
    }
    return mesh;
}

std::string encode_meshoptimizer(const TriangleMesh& mesh) {
    const BoundingBox box = bounding_box(mesh);
    Front front{mesh.vertex_count(), mesh.face_count(), 0, {}, (box.max - box.min).maxCoeff() / ((1 << kBits) - 1)};
    std::copy_n(box.min.data(), 3, front.origin);
    std::vector<GridVertex> vertices(mesh.positions.size());
    for (std::size_t v = 0; v < vertices.size(); ++v) {
        for (int axis = 0; axis < 3; ++axis)
            vertices[v].xyz[axis] =
                static_cast<std::uint16_t>(std::lround((mesh.positions[v][axis] - box.min[axis]) / front.step));
    }
    std::vector<unsigned> indices;
    for (const Triangle& face : mesh.faces) indices.insert(indices.end(), face.begin(), face.end());
    meshopt_optimizeVertexCache(indices.data(), indices.data(), indices.size(), vertices.size());
    meshopt_optimizeVertexFetch(vertices.data(), indices.data(), indices.size(), vertices.data(), vertices.size(),
                                sizeof(GridVertex));
    const std::size_t vertex_bound = meshopt_encodeVertexBufferBound(vertices.size(), sizeof(GridVertex));
    std::vector<unsigned char> buffer(vertex_bound + meshopt_encodeIndexBufferBound(indices.size(), vertices.size()));
    front.vertex_bytes =
        meshopt_encodeVertexBuffer(buffer.data(), vertex_bound, vertices.data(), vertices.size(), sizeof(GridVertex));
    const std::size_t index_bytes = meshopt_encodeIndexBuffer(buffer.data() + front.vertex_bytes,
                                                              buffer.size() - front.vertex_bytes, indices.data(), indices.size());
    require(front.vertex_bytes != 0 && index_bytes != 0, "meshoptimizer's encoder");
    std::string bytes(reinterpret_cast<const char*>(&front), sizeof(front));
    return bytes.append(reinterpret_cast<const char*>(buffer.data()), front.vertex_bytes + index_bytes);
}

TriangleMesh decode_meshoptimizer(std::string_view bytes) {
    Front front;
    require(bytes.size() > sizeof(front), "meshoptimizer's decoder");
    std::memcpy(&front, bytes.data(), sizeof(front));
    bytes.remove_prefix(sizeof(front));
    std::vector<GridVertex> vertices(front.vertices);
    TriangleMesh mesh;
    mesh.faces.resize(front.faces);
    require(front.vertex_bytes <= bytes.size() &&
                meshopt_decodeVertexBuffer(vertices.data(), vertices.size(), sizeof(GridVertex), bytes_of(bytes),
                                           front.vertex_bytes) == 0 &&
                meshopt_decodeIndexBuffer(mesh.faces.data()->data(), 3 * mesh.faces.size(), sizeof(std::uint32_t),
                                          bytes_of(bytes) + front.vertex_bytes, bytes.size() - front.vertex_bytes) == 0,
            "meshoptimizer's decoder");
    const Vec3 origin(front.origin[0], front.origin[1], front.origin[2]);
    mesh.positions.reserve(vertices.size());
    for (const GridVertex& v : vertices) mesh.positions.push_back(origin + Vec3(v.xyz[0], v.xyz[1], v.xyz[2]) * front.step);
    return mesh;
}

}  // namespace vsplit::bench

#include "service/representation.h"

#include <utility>

#include "vsplit/mrr/progressive_mesh.h"

namespace vsplit::service {
namespace {

// A mesh takes about as much memory as the representation itself.
constexpr std::size_t kCachedMeshes = 2;

// Each about half as much.
constexpr std::size_t kKeptEncodings = 2;

}  // namespace

Representation::Representation(std::string id, MeshRef source, MethodResult result)
    : id_(std::move(id)),
      source_(std::move(source)),
      result_(std::move(result)),
      meshes_(kCachedMeshes),
      encoded_(kKeptEncodings) {}

std::size_t Representation::level_for(std::uint32_t faces) const { return mrr().level_for(faces == 0 ? result_.faces : faces); }

std::shared_ptr<const TriangleMesh> Representation::mesh(std::size_t level) const {
    return meshes_.get_or_make(level, [&] { return mesh_at(mrr(), level); });
}

std::shared_ptr<EncodedRecords> Representation::encoded(const EncodingChoice& choice) const {
    const std::size_t key = static_cast<std::size_t>(choice.encoding) * (kMostBits + 1) + choice.bits;
    return *encoded_.get_or_make(key, [&] { return std::make_shared<EncodedRecords>(mrr(), choice); });
}

Quality Representation::quality(std::size_t level) const {
    return mrr().faces_at(level) == result_.faces ? result_.quality : measure_quality(*mesh(level));
}

}  // namespace vsplit::service

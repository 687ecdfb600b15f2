#include "service/memory_use.h"

namespace vsplit::service {
namespace {

// Measured: docs/operations.md.
constexpr std::uint64_t kBytesAFace = 260;
constexpr std::uint64_t kReadFactor = 3;

}  // namespace

std::uint64_t memory_of(const TriangleMesh& mesh) {
    return mesh.positions.size() * sizeof(Vec3) + mesh.faces.size() * sizeof(Triangle) + mesh.regions.size() * sizeof(std::uint32_t);
}

std::uint64_t memory_of(const MultiresMesh& mrr) {
    const RecordSpan records = mrr.records;
    return memory_of(mrr.base) + records.kinds.size_bytes() + records.splits.size_bytes() + records.flips.size_bytes() +
           records.moves.size_bytes() + (mrr.border_splits.size() + mrr.regions.size()) * sizeof(std::uint32_t);
}

std::uint64_t memory_to_read(std::uint64_t file_bytes) { return kReadFactor * file_bytes; }

std::uint64_t memory_to_simplify(std::uint64_t faces) { return kBytesAFace * faces; }

}  // namespace vsplit::service

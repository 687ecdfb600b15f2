#include "service/memory_use.h"

#include <variant>

#include "vsplit/io/mesh_format.h"
#include "vsplit/io/read_mesh.h"

namespace vsplit::service {
namespace {

// Measured: docs/operations.md, "Memory". Bytes a face.
constexpr std::uint64_t kToSimplify = 260;
constexpr std::uint64_t kToReadStl = 70;
constexpr std::uint64_t kToRead = 150;  // with the three vertices a face that a reader takes at most
constexpr std::uint64_t kToRepair = 270;
constexpr std::uint64_t kToMeasure = 100;
constexpr std::uint64_t kToWrite = 250;
constexpr std::uint64_t kToWriteSecondOrder = 550;

// Of a file, a face usually takes no less.
constexpr std::uint64_t kStlFace = 50;
constexpr std::uint64_t kOtherFace = 20;

}  // namespace

std::uint64_t memory_of(const TriangleMesh& mesh) {
    std::uint64_t names = 0;
    for (const FaceSet& set : mesh.sets) names += sizeof(FaceSet) + set.name.size() + set.regions.size() * sizeof(std::uint32_t);
    return names + mesh.positions.size() * sizeof(Vec3) + mesh.faces.size() * sizeof(Triangle) +
           mesh.regions.size() * sizeof(std::uint32_t);
}

std::uint64_t memory_of(const MultiresMesh& mrr) {
    const RecordSpan records = mrr.records;
    return memory_of(mrr.base) + records.kinds.size_bytes() + records.splits.size_bytes() + records.flips.size_bytes() +
           records.moves.size_bytes() + (mrr.border_splits.size() + mrr.regions.size()) * sizeof(std::uint32_t);
}

std::uint64_t memory_of(const MethodOptions& options) {
    return std::visit(
        [](const auto& o) {
            const std::size_t field = o.sizing ? o.sizing->field.size() : 0;
            return (o.marked_edges.size() + o.regions.size()) * sizeof(std::uint32_t) + field * sizeof(double);
        },
        options);
}

ReadingEstimate estimate_reading(std::span<const std::byte> file, bool repair) {
    const bool stl = detect_format(file) == MeshFormat::kStlBinary;
    return {1 + unpacked_size(file) / (stl ? kStlFace : kOtherFace), repair ? kToRepair : stl ? kToReadStl : kToRead};
}

std::uint64_t memory_to_repair(std::uint64_t faces) { return kToRepair * faces; }

std::uint64_t memory_to_measure(std::uint64_t faces) { return kToMeasure * faces; }

std::uint64_t memory_to_write(std::uint64_t faces, unsigned order) {
    return faces * (order == 2 ? kToWriteSecondOrder : kToWrite);
}

std::uint64_t memory_to_simplify(std::uint64_t faces) { return kToSimplify * faces; }

}  // namespace vsplit::service

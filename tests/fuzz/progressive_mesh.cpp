#include "vsplit/mrr/progressive_mesh.h"

#include <cstdint>
#include <cstring>

#include "check.h"
#include "vsplit/mesh/inspect.h"

namespace {

using namespace vsplit;

/// Takes numbers off the front of the fuzzer's bytes; zeros when there are no more.
class Numbers {
public:
    Numbers(const std::uint8_t* data, std::size_t size) : data_(data), left_(size) {}

    template <class T>
    T next() {
        T value{};
        if (left_ >= sizeof(T)) {
            std::memcpy(&value, data_, sizeof(T));
            data_ += sizeof(T);
            left_ -= sizeof(T);
        } else {
            left_ = 0;
        }
        return value;
    }

    Vec3 point() { return {next<float>(), next<float>(), next<float>()}; }
    [[nodiscard]] bool empty() const { return left_ == 0; }

private:
    const std::uint8_t* data_;
    std::size_t left_;
};

TriangleMesh read_base(Numbers& numbers) {
    TriangleMesh mesh;
    const unsigned vertices = numbers.next<std::uint8_t>() % 16U;
    const unsigned faces = numbers.next<std::uint8_t>() % 32U;
    for (unsigned i = 0; i < vertices; ++i) mesh.positions.push_back(numbers.point());
    for (unsigned i = 0; i < faces; ++i) {
        mesh.faces.push_back({numbers.next<std::uint8_t>(), numbers.next<std::uint8_t>(), numbers.next<std::uint8_t>()});
    }
    return mesh;
}

TriangleMesh tetrahedron() {
    return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
}

RecordList read_record(Numbers& numbers, unsigned kind) {
    if (kind == 0) {
        VertexSplit split;
        split.anchor = numbers.next<std::uint16_t>();
        split.steps = numbers.next<std::uint16_t>();
        split.kept = numbers.point();
        split.added = numbers.point();
        return {split};
    }
    if (kind == 1) return {EdgeFlip{numbers.next<std::uint16_t>()}};
    const std::uint32_t vertex = numbers.next<std::uint16_t>();
    return {VertexMove{vertex, numbers.point()}};
}

void try_record(ProgressiveMesh& mesh, const RecordList& record) {
    const TriangleMesh before = mesh.mesh();
    const std::size_t records = mesh.records();
    if (!mesh.refine(record)) {
        fuzz::check(mesh.mesh() == before && mesh.records() == records, "a refused record changes nothing");
        return;
    }
    fuzz::check(mesh.mesh().face_count() == before.face_count() + 2 * record.splits().size(), "a split makes two faces");
    fuzz::check(mesh.last() == record[0], "the last record is the one that fitted");
    mesh.rewind(records);
    fuzz::check(mesh.mesh() == before, "a record is undone exactly");
    fuzz::check(static_cast<bool>(mesh.refine(record)), "a record that fitted fits again");
}

}  // namespace

/// A base mesh (the lowest bit of the first byte: the tetrahedron, the next two: how many ghosts), then, a byte before each,
/// records of all kinds and ways back: refine must refuse or apply each, and what was applied must stay a closed manifold and be
/// undone exactly.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    Numbers numbers(data, size);
    const unsigned first = numbers.next<std::uint8_t>();
    const TriangleMesh given = (first & 1U) != 0 ? tetrahedron() : read_base(numbers);
    Expected<ProgressiveMesh> mesh = ProgressiveMesh::from_base(given, first >> 1U & 3U);
    if (!mesh) return 0;
    const TriangleMesh base = mesh->mesh();
    for (int step = 0; !numbers.empty() && step < 100 && mesh->level() < 64; ++step) {
        const unsigned kind = numbers.next<std::uint8_t>() % 4U;
        if (kind == 3) {
            mesh->coarsen(numbers.next<std::uint8_t>() % 8U);
            continue;
        }
        try_record(*mesh, read_record(numbers, kind));
    }
    const MeshReport report = inspect(mesh->mesh());
    fuzz::check(report.closed && report.genus == inspect(base).genus, "the mesh stays closed and of its genus");
    const std::uint32_t ghost_faces = count_ghost_faces(base, mesh->ghosts());
    fuzz::check(
        mesh->visible().face_count() == base.face_count() - ghost_faces + 2 * mesh->level() - mesh->border_splits().size(),
        "visible faces are counted");
    mesh->coarsen(mesh->level());
    fuzz::check(mesh->records() == 0 && mesh->mesh() == base, "undoing every record gives the base");
    return 0;
}

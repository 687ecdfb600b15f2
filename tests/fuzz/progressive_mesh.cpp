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

}  // namespace

/// A base mesh (the lowest bit of the first byte: the tetrahedron), then splits: refine must refuse or apply each, and what was
/// applied must stay a closed manifold and be undone exactly.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    Numbers numbers(data, size);
    const bool given = (numbers.next<std::uint8_t>() & 1U) != 0;
    Expected<ProgressiveMesh> mesh = ProgressiveMesh::from_base(given ? tetrahedron() : read_base(numbers));
    if (!mesh) return 0;
    const TriangleMesh base = mesh->mesh();
    while (!numbers.empty() && mesh->level() < 64) {
        VertexSplit split;
        split.anchor = numbers.next<std::uint16_t>();
        split.steps = numbers.next<std::uint16_t>();
        split.kept = numbers.point();
        split.added = numbers.point();
        const TriangleMesh before = mesh->mesh();
        if (mesh->refine({&split, 1})) {
            fuzz::check(mesh->mesh().face_count() == before.face_count() + 2, "a split makes two faces");
        } else {
            fuzz::check(mesh->mesh() == before, "a refused split changes nothing");
        }
    }
    const MeshReport report = inspect(mesh->mesh());
    fuzz::check(report.closed && report.genus == inspect(base).genus, "the mesh stays closed and of its genus");
    mesh->coarsen(mesh->level());
    fuzz::check(mesh->mesh() == base, "undoing every split gives the base");
    return 0;
}

#pragma once

#include <cstdint>
#include <vector>

#include "mesh/half_edges.h"
#include "mesh/index_table.h"
#include "mesh/point_hash.h"
#include "mrr/grid_codes.h"
#include "mrr/symbols.h"

namespace vsplit {

/// How a face of the walk gets its third vertex.
enum class ThirdVertex : std::uint8_t {
    kNew = 0,    ///< the next one that has not been seen
    kRight = 1,  ///< the open edge that ends at the second vertex begins there
    kLeft = 2,   ///< the open edge that begins at the first vertex ends there
    kNamed = 3,  ///< any other that has been seen, by its number
};

/// Codes a mesh whose faces go as walk_faces does and whose vertices come in the order in which those faces need them, ghosts
/// first. Open edges are those of faces that were coded whose other face has not come yet.
template <class Symbols, class Codes>
class WalkCoder {
public:
    WalkCoder(Symbols symbols, const Codes& codes, TriangleMesh& mesh) : symbols_(symbols), codes_(codes), mesh_(mesh) {}

    /// Writing: all of the mesh. Reading: fills it in; false where the symbols make no mesh of that many vertices and faces.
    [[nodiscard]] bool code(std::uint32_t vertices, std::uint32_t faces, std::uint32_t ghosts) {
        vertices_ = vertices;
        while (known_ < ghosts) {
            if (!code_new_vertex(known_ == 0 ? Vec3(Vec3::Zero()) : mesh_.positions[known_ - 1], kScales - 1, 1)) return false;
        }
        while (coded_ < faces) {
            if (!code_first_face()) return false;
            while (!gates_.empty()) {
                const HalfEdge gate = gates_.back();
                gates_.pop_back();
                if (twin_[gate] != kNone) continue;
                if (coded_ == faces || !code_face_behind(gate)) return false;
            }
        }
        return known_ == vertices;
    }

private:
    /// The first face of a component: three vertices that are new or ghosts.
    bool code_first_face() {
        Triangle face{};
        if constexpr (Symbols::kWrites) face = mesh_.faces[coded_];
        for (std::uint32_t& vertex : face) {
            std::uint32_t symbol = Symbols::kWrites && vertex != known_ ? number(ThirdVertex::kNamed) : number(ThirdVertex::kNew);
            symbols_.byte(column::kKinds, symbol);
            const Vec3 near = known_ == 0 ? Vec3(Vec3::Zero()) : mesh_.positions[known_ - 1];
            if (!take_vertex(symbol, vertex, near, kScales - 1, 1)) return false;
        }
        if (!add(face)) return false;
        const HalfEdge first = 3 * (coded_ - 1);
        gates_.insert(gates_.end(), {first, prev(first), next(first)});
        return true;
    }

    bool code_face_behind(HalfEdge gate) {
        const std::uint32_t a = origin(mesh_, next(gate)), b = origin(mesh_, gate), d = origin(mesh_, prev(gate));
        std::uint32_t c = 0;
        std::uint32_t symbol = 0;
        if constexpr (Symbols::kWrites) {
            c = mesh_.faces[coded_][2];
            symbol = number(c == known_        ? ThirdVertex::kNew
                            : c == right(gate) ? ThirdVertex::kRight
                            : c == left(gate)  ? ThirdVertex::kLeft
                                               : ThirdVertex::kNamed);
        }
        symbols_.byte(column::kKinds, symbol);
        if (symbol == number(ThirdVertex::kRight)) {
            c = right(gate);
        } else if (symbol == number(ThirdVertex::kLeft)) {
            c = left(gate);
        } else {
            const Vec3 pa = mesh_.positions[a], pb = mesh_.positions[b];
            const Vec3 across = (pa + pb) - mesh_.positions[d];
            const double length = (pa - pb).cwiseAbs().maxCoeff();
            if (!take_vertex(symbol, c, across, -1, length)) return false;
        }
        if (!add({a, b, c})) return false;
        const HalfEdge first = 3 * (coded_ - 1);
        gates_.insert(gates_.end(), {prev(first), next(first)});
        return true;
    }

    static std::uint32_t number(ThirdVertex kind) { return static_cast<std::uint32_t>(kind); }

    bool take_vertex(std::uint32_t symbol, std::uint32_t& vertex, const Vec3& expected, int scale, double length) {
        if (symbol == number(ThirdVertex::kNew)) {
            vertex = known_;
            return code_new_vertex(expected, scale, length);
        }
        if (symbol != number(ThirdVertex::kNamed) || known_ == 0) return false;
        code_uniform(symbols_, column::kPlace, vertex, known_);
        return vertex < known_;
    }

    /// `scale` below 0: that of `length` at each coordinate.
    bool code_new_vertex(const Vec3& expected, int scale, double length) {
        if (known_ == vertices_) return false;
        if constexpr (!Symbols::kWrites) mesh_.positions.push_back(Vec3::Zero());
        Vec3& position = mesh_.positions[known_];
        for (unsigned axis = 0; axis < 3; ++axis) {
            const unsigned at = scale >= 0 ? static_cast<unsigned>(scale) : codes_.scale(length, expected[axis]);
            if (!code_coordinate(symbols_, codes_, column::kAlong + at, expected[axis], axis, position[axis])) return false;
        }
        ++known_;
        return !symbols_.ran_short();
    }

    /// The face that was coded: its edges find their twins. False for an edge that two faces run along the same way.
    bool add(const Triangle& face) {
        if constexpr (!Symbols::kWrites) mesh_.faces.push_back(face);
        const HalfEdge first = 3 * coded_++;
        twin_.insert(twin_.end(), 3, kNone);
        half_edges_.reserve(twin_.size());
        for (const HalfEdge h : {first, next(first), prev(first)}) {
            const std::uint32_t from = origin(mesh_, h), to = origin(mesh_, next(h));
            if (find(from, to) != kNone) return false;
            half_edges_.insert(hash_(from, to), h);
            const HalfEdge back = find(to, from);
            if (back == kNone) continue;
            twin_[h] = back;
            twin_[back] = h;
        }
        return !symbols_.ran_short();
    }

    /// Of the half-edges that were coded the one that runs from a vertex to another; kNone where there is none.
    [[nodiscard]] HalfEdge find(std::uint32_t from, std::uint32_t to) const {
        return half_edges_.find(hash_(from, to),
                                [&](HalfEdge h) { return origin(mesh_, h) == from && origin(mesh_, next(h)) == to; });
    }

    // Both turn from an open edge on, so they end at another at the latest.
    [[nodiscard]] std::uint32_t right(HalfEdge gate) const {
        HalfEdge h = gate;
        while (twin_[prev(h)] != kNone) h = twin_[prev(h)];
        return origin(mesh_, prev(h));
    }
    [[nodiscard]] std::uint32_t left(HalfEdge gate) const {
        HalfEdge h = gate;
        while (twin_[next(h)] != kNone) h = twin_[next(h)];
        return origin(mesh_, prev(h));
    }

    Symbols symbols_;
    const Codes codes_;
    TriangleMesh& mesh_;
    std::uint32_t vertices_ = 0;
    std::uint32_t known_ = 0;  // vertices
    std::uint32_t coded_ = 0;  // faces
    std::vector<HalfEdge> gates_;
    std::vector<HalfEdge> twin_;
    const PointHash hash_;
    IndexTable half_edges_;  // by origin and end
};

/// Codes any mesh: indices and coordinates as differences to the ones before.
template <class Symbols, class Codes>
[[nodiscard]] bool code_plain(Symbols symbols, const Codes& codes, TriangleMesh& mesh, std::uint32_t vertices,
                              std::uint32_t faces) {
    Vec3 before = Vec3::Zero();
    for (std::uint32_t v = 0; v < vertices; ++v) {
        if constexpr (!Symbols::kWrites) mesh.positions.push_back(Vec3::Zero());
        Vec3& position = mesh.positions[v];
        for (unsigned axis = 0; axis < 3; ++axis) {
            const unsigned column = column::kAlong + axis;
            if (!code_coordinate(symbols, codes, column, before[axis], axis, position[axis])) return false;
        }
        before = position;
        if (symbols.ran_short()) return false;
    }
    std::uint32_t last = 0;
    for (std::uint32_t f = 0; f < faces; ++f) {
        if constexpr (!Symbols::kWrites) mesh.faces.push_back({});
        for (std::uint32_t& vertex : mesh.faces[f]) {
            std::uint32_t step = to_zigzag(static_cast<std::int32_t>(vertex - last));
            symbols.number(column::kMoved, step);
            vertex = last = last + static_cast<std::uint32_t>(from_zigzag(step));
        }
        if (symbols.ran_short()) return false;
    }
    return true;
}

}  // namespace vsplit

#pragma once

#include <cstdint>
#include <vector>

#include "mesh/half_edges.h"

namespace vsplit {

/// The faces of a closed mesh in an order in which each (but the first of a component) stands beside one before it: a walk that
/// keeps turning right around what it has seen, so that most faces bring one new vertex or close a gap. Each face is given by the
/// corner it is to begin with: the one its edge to the face before leaves. Components follow one another by their lowest face.
/// `is_there(face)` says which of `faces` faces count, `twin(half_edge)` how they hang together. O(faces).
template <class IsThere, class Twin>
[[nodiscard]] std::vector<HalfEdge> walk_faces(std::uint32_t faces, const IsThere& is_there, const Twin& twin) {
    std::vector<HalfEdge> order;
    std::vector<std::uint8_t> seen(faces, 0);
    std::vector<HalfEdge> gates;  // half-edges of faces that may not have been seen
    for (std::uint32_t first = 0; first < faces; ++first) {
        if (seen[first] != 0 || !is_there(first)) continue;
        const HalfEdge start = 3 * first;
        seen[first] = 1;
        order.push_back(start);
        gates.insert(gates.end(), {twin(start), twin(prev(start)), twin(next(start))});
        while (!gates.empty()) {
            const HalfEdge gate = gates.back();
            gates.pop_back();
            if (seen[face_of(gate)] != 0) continue;
            seen[face_of(gate)] = 1;
            order.push_back(gate);
            gates.insert(gates.end(), {twin(prev(gate)), twin(next(gate))});
        }
    }
    return order;
}

}  // namespace vsplit

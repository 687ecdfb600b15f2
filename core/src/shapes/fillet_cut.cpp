#include "shapes/fillet_cut.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <utility>

namespace vsplit {
namespace {

constexpr double kPlane = 0.9986;                // cosine between normals of one plane: 3 degrees
constexpr std::size_t kMostBridges = 1U << 22U;  // pairs of vertices that a band is searched among

using Side = std::vector<std::uint32_t>;

Error cannot(std::string why) { return {Cause::kUnsupported, std::move(why), ""}; }

std::string name_of(std::uint32_t vertex) { return "its end at vertex " + std::to_string(vertex); }

/// The part of a closed border from the half-edge that leaves `from` to the one that reaches `to`.
Rim part_of(const TriangleMesh& mesh, const Rim& rim, std::uint32_t from, std::uint32_t to) {
    Rim part;
    const auto first = std::find_if(rim.begin(), rim.end(), [&](HalfEdge h) { return origin(mesh, h) == from; });
    auto at = static_cast<std::size_t>(first - rim.begin());
    for (std::size_t i = 0; i < rim.size() && first != rim.end(); ++i, at = (at + 1) % rim.size()) {
        part.push_back(rim[at]);
        if (origin(mesh, next(rim[at])) == to) return part;
    }
    return {};
}

/// Faces around the inner vertices of an arc that are not the fillet's, ascending.
Expected<std::vector<std::uint32_t>> beside_arc(const TriangleMesh& mesh, const FaceNormals& normals,
                                                const std::vector<HalfEdge>& twin, const ShapeFeature& fillet, const Rim& arc) {
    std::set<std::uint32_t> faces;
    for (std::size_t i = 1; i < arc.size(); ++i) {
        HalfEdge h = arc[i];
        do {
            if (!std::binary_search(fillet.faces.begin(), fillet.faces.end(), face_of(h))) faces.insert(face_of(h));
            h = twin[prev(h)];
        } while (h != arc[i]);
    }
    for (const std::uint32_t f : faces) {
        if (normals.normals[f].dot(normals.normals[*faces.begin()]) < kPlane)
            return cannot(name_of(origin(mesh, arc.front())) + " does not lie in one plane");
    }
    return std::vector<std::uint32_t>(faces.begin(), faces.end());
}

struct ArcEnd {
    std::vector<std::uint32_t> faces;
    Rim border;
};

Expected<ArcEnd> open_end(const TriangleMesh& mesh, const FaceNormals& normals, const std::vector<HalfEdge>& twin,
                          const ShapeFeature& fillet, const Rim& arc) {
    const std::uint32_t from = origin(mesh, arc.front()), to = origin(mesh, next(arc.back()));
    Expected<std::vector<std::uint32_t>> faces = beside_arc(mesh, normals, twin, fillet, arc);
    if (!faces) return faces.error();
    if (faces->empty()) return ArcEnd{};
    const Expected<std::vector<Rim>> rims = find_rims(mesh, twin, *faces);
    if (!rims) return cannot(name_of(from) + " meets faces whose border touches itself");
    if (rims->size() > 1) return cannot(name_of(from) + " meets faces around another opening");
    // The faces run along the arc the other way, so what is left goes on where it begins for the fillet.
    Rim border = part_of(mesh, rims->front(), from, to);
    if (border.size() + arc.size() != rims->front().size())
        return cannot(name_of(from) + " meets more than the faces beside its arc");
    return ArcEnd{*std::move(faces), std::move(border)};
}

/// The band between two sides by dynamic programming: the sum of the lengths of the edges between them is least (Fuchs, Kedem,
/// Uselton: Optimal Surface Reconstruction from Planar Contours, 1977, with lengths for areas).
class Band {
public:
    using Place = std::pair<std::size_t, std::size_t>;  // on either side

    Band(const TriangleMesh& mesh, const ShapeFeature& fillet, const HasEdge& has_edge)
        : a_(fillet.sides[0]), b_(fillet.sides[1]), cost_(a_.size() * b_.size(), kForbidden) {
        for (std::size_t i = 0; i < a_.size(); ++i) {
            for (std::size_t j = 0; j < b_.size(); ++j) {
                if (has_edge(a_[i], b_[j])) continue;
                const double before = i + j == 0 ? 0 : std::min(cost(i, j, 1, 0), cost(i, j, 0, 1));
                cost_[i * b_.size() + j] = before + (mesh.positions[a_[i]] - mesh.positions[b_[j]]).norm();
            }
        }
    }

    [[nodiscard]] bool found() const { return cost_.back() < kForbidden; }

    /// From one end to the other: one step on one of the sides each.
    [[nodiscard]] std::vector<Place> path() const {
        std::vector<Place> path{{a_.size() - 1, b_.size() - 1}};
        while (path.back() != Place{0, 0}) {
            const auto [i, j] = path.back();
            path.push_back(cost(i, j, 1, 0) <= cost(i, j, 0, 1) ? Place{i - 1, j} : Place{i, j - 1});
        }
        std::reverse(path.begin(), path.end());
        return path;
    }

    /// Where a band that goes around is best cut in two, each without a vertex twice; 0 where that cannot be.
    [[nodiscard]] std::size_t half_of(const std::vector<Place>& path) const {
        std::size_t best = 0;
        for (std::size_t k = 1; k + 1 < path.size(); ++k) {
            const auto [i, j] = path[k];
            const bool inside = i > 0 && j > 0 && i + 1 < a_.size() && j + 1 < b_.size();
            if (inside && (best == 0 || 2 * k <= path.size())) best = k;
        }
        return best;
    }

    /// Whether no two of its edges join the same vertices; the last one of a band that goes around is the first.
    [[nodiscard]] bool is_simple(const std::vector<Place>& path, bool closed) const {
        std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
        const std::size_t count = path.size() - (closed ? 1 : 0);
        for (std::size_t k = 0; k < count; ++k) edges.emplace(a_[path[k].first], b_[path[k].second]);
        return edges.size() == count;
    }

    [[nodiscard]] BandPiece piece(const std::vector<Place>& path, std::size_t first, std::size_t last) const {
        BandPiece piece;
        const auto [a_from, b_from] = path[first];
        const auto [a_to, b_to] = path[last];
        for (std::size_t i = a_from; i <= a_to; ++i) piece.border.push_back(a_[i]);
        for (std::size_t j = b_to + 1; j-- > b_from;) piece.border.push_back(b_[j]);
        for (std::size_t k = first; k < last; ++k) {
            const auto [i, j] = path[k];
            const bool on_a = path[k + 1].first > i;
            piece.faces.push_back(on_a ? Triangle{a_[i], a_[i + 1], b_[j]} : Triangle{b_[j + 1], b_[j], a_[i]});
        }
        return piece;
    }

private:
    static constexpr double kForbidden = std::numeric_limits<double>::infinity();

    [[nodiscard]] double cost(std::size_t i, std::size_t j, std::size_t back_a, std::size_t back_b) const {
        if (i < back_a || j < back_b) return kForbidden;
        return cost_[(i - back_a) * b_.size() + j - back_b];
    }

    const Side& a_;
    const Side& b_;
    std::vector<double> cost_;
};

/// The faces of a fillet at its sides, by the vertices that their edges there begin and end at.
std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> faces_at_sides(const TriangleMesh& mesh,
                                                                                const std::vector<HalfEdge>& twin,
                                                                                const ShapeFeature& fillet) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> faces;
    for (const std::uint32_t f : fillet.faces) {
        for (HalfEdge h = 3 * f; h < 3 * f + 3; ++h) {
            if (!std::binary_search(fillet.faces.begin(), fillet.faces.end(), face_of(twin[h])))
                faces.emplace(std::pair(origin(mesh, h), origin(mesh, next(h))), f);
        }
    }
    return faces;
}

}  // namespace

Expected<FilletCut> cut_fillet(const TriangleMesh& mesh, const FaceNormals& normals, const std::vector<HalfEdge>& twin,
                               const ShapeFeature& fillet) {
    FilletCut cut{fillet.faces, {}};
    const auto& [first, second] = fillet.sides;
    if (first.front() == first.back()) return cut;
    const Expected<std::vector<Rim>> rims = find_rims(mesh, twin, fillet.faces);
    if (!rims) return rims.error();
    for (const auto& [from, to] : {std::pair(first.back(), second.back()), std::pair(second.front(), first.front())}) {
        Expected<ArcEnd> end = open_end(mesh, normals, twin, fillet, part_of(mesh, rims->front(), from, to));
        if (!end) return end.error();
        cut.faces.insert(cut.faces.end(), end->faces.begin(), end->faces.end());
        if (!end->border.empty()) cut.ends.push_back(std::move(end->border));
    }
    std::sort(cut.faces.begin(), cut.faces.end());
    if (std::adjacent_find(cut.faces.begin(), cut.faces.end()) != cut.faces.end()) return cannot("its ends share a face");
    return cut;
}

Expected<std::vector<BandPiece>> band_between_sides(const TriangleMesh& mesh, const FaceNormals& normals,
                                                    const std::vector<HalfEdge>& twin, const ShapeFeature& fillet,
                                                    const HasEdge& has_edge) {
    const auto& [first, second] = fillet.sides;
    if (first.size() > kMostBridges / second.size()) {
        return cannot("its sides have " + std::to_string(first.size()) + " and " + std::to_string(second.size()) +
                      " vertices; bridged are sides with a product of at most " + std::to_string(kMostBridges));
    }
    const Band band(mesh, fillet, has_edge);
    if (!band.found()) return cannot("every band between its sides needs an edge that is there already");
    const std::vector<Band::Place> path = band.path();
    const std::size_t last = path.size() - 1;
    const bool closed = first.front() == first.back();
    const std::size_t middle = closed ? band.half_of(path) : last;
    if (middle == 0 || !band.is_simple(path, closed)) return cannot("the band between its sides would join two vertices twice");
    std::vector<BandPiece> pieces{band.piece(path, 0, middle)};
    if (closed) pieces.push_back(band.piece(path, middle, last));
    const auto beside = faces_at_sides(mesh, twin, fillet);
    for (const BandPiece& piece : pieces) {
        for (const Triangle& t : piece.faces) {
            const Vec3 up = (mesh.positions[t[1]] - mesh.positions[t[0]]).cross(mesh.positions[t[2]] - mesh.positions[t[0]]);
            if (!(up.dot(normals.normals[beside.at({t[0], t[1]})]) > kFold * up.norm()))
                return cannot("the band between its sides at vertex " + std::to_string(t[0]) + " folds over");
        }
    }
    return pieces;
}

}  // namespace vsplit

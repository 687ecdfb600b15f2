#include "shapes/rims.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <string>

#include "repair/loop_triangulation.h"

namespace vsplit {
namespace {

constexpr std::size_t kMostEdges = 500;  // the cubic search takes 0.1 s for so many

Error cannot(std::string why) { return {Cause::kUnsupported, std::move(why), ""}; }

}  // namespace

Expected<std::vector<Rim>> find_rims(const TriangleMesh& mesh, const std::vector<HalfEdge>& twin,
                                     const std::vector<std::uint32_t>& faces) {
    std::map<std::uint32_t, HalfEdge> leaving;  // border half-edges by origin
    std::vector<HalfEdge> border;
    for (const std::uint32_t f : faces) {
        for (HalfEdge h = 3 * f; h < 3 * f + 3; ++h) {
            if (std::binary_search(faces.begin(), faces.end(), face_of(twin[h]))) continue;
            border.push_back(h);
            if (leaving.emplace(origin(mesh, h), h).second) continue;
            return cannot("its rim touches itself at vertex " + std::to_string(origin(mesh, h)));
        }
    }
    std::vector<Rim> rims;
    for (const HalfEdge first : border) {
        Rim rim;
        std::uint32_t at = origin(mesh, first);
        for (auto found = leaving.find(at); found != leaving.end(); found = leaving.find(at)) {
            rim.push_back(found->second);
            at = origin(mesh, next(found->second));
            leaving.erase(found);
        }
        if (!rim.empty()) rims.push_back(std::move(rim));
    }
    return rims;
}

Ring origins(const TriangleMesh& mesh, const Rim& rim) {
    Ring ring;
    for (const HalfEdge h : rim) ring.push_back(origin(mesh, h));
    return ring;
}

Expected<std::vector<Triangle>> fill_ring(const TriangleMesh& mesh, const Ring& ring, const HasEdge& has_edge) {
    if (ring.size() > kMostEdges) {
        return cannot("a rim of it has " + std::to_string(ring.size()) + " edges; filled are rims of at most " +
                      std::to_string(kMostEdges));
    }
    if (ring.size() < 3) return cannot("a rim of it has fewer than three edges");
    std::vector<Vec3> corners;
    for (const std::uint32_t v : ring) corners.push_back(mesh.positions[v]);
    std::vector<Triangle> faces =
        triangulate_loop(corners, [&](std::uint32_t i, std::uint32_t j) { return !has_edge(ring[i], ring[j]); });
    const std::string where = "the rim at vertex " + std::to_string(ring.front());
    if (faces.empty()) return cannot("every filling of " + where + " needs an edge that is there already");
    std::vector<Vec3> areas;
    Vec3 whole = Vec3::Zero();
    for (const Triangle& t : faces) {
        areas.emplace_back((corners[t[1]] - corners[t[0]]).cross(corners[t[2]] - corners[t[0]]));
        whole += areas.back();
    }
    const double tiny = 1e-9 * whole.norm();
    const Vec3 up = whole.normalized();
    for (const Vec3& area : areas) {
        if (area.norm() > tiny && area.dot(up) < kFold * area.norm()) return cannot("a filling of " + where + " folds over");
    }
    for (Triangle& t : faces) {
        for (std::uint32_t& corner : t) corner = ring[corner];
    }
    return faces;
}

}  // namespace vsplit

#include "simplify/border_guard.h"

#include <utility>

namespace vsplit {
namespace {

/// The boundary's edges, each as it is seen from its visible face.
std::vector<EdgeEnds> boundary_edges(const HalfEdgeMesh& mesh, const Border& border) {
    std::vector<EdgeEnds> edges;
    for (HalfEdge h = 0; h < mesh.half_edge_count(); ++h) {
        const std::uint32_t from = mesh.origin(h), to = mesh.target(h);
        if (border.is_ghost(mesh.origin(prev(h))) && !border.is_ghost(from) && !border.is_ghost(to)) edges.push_back({to, from});
    }
    return edges;
}

CreaseIndex index_of(const HalfEdgeMesh& mesh, const std::vector<EdgeEnds>& edges) {
    std::vector<SegmentShape> shapes;
    shapes.reserve(edges.size());
    for (const EdgeEnds& e : edges) shapes.push_back({{mesh.position(e[0]), mesh.position(e[1])}});
    return CreaseIndex(std::move(shapes));
}

}  // namespace

BorderGuard::BorderGuard(const HalfEdgeMesh& mesh, const Border& border, double limit)
    : limit_(limit), first_(mesh.vertex_count(), kNone), source_(index_of(mesh, boundary_edges(mesh, border))) {
    for (const EdgeEnds& edge : boundary_edges(mesh, border)) {
        first_[edge[0]] = static_cast<std::uint32_t>(points_.size());
        next_.push_back(kNone);
        points_.push_back(mesh.position(edge[0]));
    }
}

bool BorderGuard::reaches_source(const Vec3& from, const Vec3& to) const {
    for (const double share : {0.25, 0.5, 0.75, 1.0}) {
        if (!source_.within(from + share * (to - from), limit_)) return false;
    }
    return true;
}

bool BorderGuard::collect(std::uint32_t owner) {
    if (owner == kNone) return true;
    for (std::uint32_t point = first_[owner]; point != kNone; point = next_[point]) {
        const double before = before_.closest(points_[point]).squared_distance;
        const double after = after_.closest(points_[point]).squared_distance;
        if (!(std::min(before, after) <= limit_ * limit_)) return false;
        places_.push_back({point, before < after ? last_ : ends_.kept});
    }
    return true;
}

bool BorderGuard::admits(const Fan& fan, const Vec3& at, const Ends& ends) {
    ends_ = ends;
    last_ = fan.vertex(fan.size());
    before_ = {{fan.ring(fan.size()), at}};
    after_ = {{at, fan.ring(0)}};
    places_.clear();
    return collect(last_) && collect(ends.kept) && collect(ends.removed) && reaches_source(before_.corners[0], at) &&
           reaches_source(after_.corners[1], at);
}

void BorderGuard::commit() {
    for (const std::uint32_t owner : {last_, ends_.kept, ends_.removed}) {
        if (owner != kNone) first_[owner] = kNone;
    }
    for (const Place& place : places_) {
        next_[place.point] = first_[place.owner];
        first_[place.owner] = place.point;
    }
}

}  // namespace vsplit

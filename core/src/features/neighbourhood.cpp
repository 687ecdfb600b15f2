#include "features/neighbourhood.h"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace vsplit {
namespace {

bool farther(const EdgePaths::Reached& left, const EdgePaths::Reached& right) {
    return std::tie(left.distance, left.vertex) > std::tie(right.distance, right.vertex);
}

}  // namespace

VertexCorners::VertexCorners(const TriangleMesh& mesh) : first_(mesh.positions.size() + 1, 0), corners_(mesh.faces.size() * 3) {
    for (HalfEdge h = 0; h < corners_.size(); ++h) ++first_[origin(mesh, h) + 1];
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    std::vector<std::uint32_t> slot(first_.begin(), first_.end() - 1);
    for (HalfEdge h = 0; h < corners_.size(); ++h) corners_[slot[origin(mesh, h)]++] = h;
}

void EdgePaths::offer(std::uint32_t vertex, double distance) {
    if (distance > radius_ || distance >= distance_[vertex]) return;
    if (distance_[vertex] == kFar) touched_.push_back(vertex);
    distance_[vertex] = distance;
    heap_.push_back({distance, vertex});
    std::push_heap(heap_.begin(), heap_.end(), farther);
}

std::span<const EdgePaths::Reached> EdgePaths::search(std::span<const std::uint32_t> sources, double radius) {
    for (const std::uint32_t v : touched_) distance_[v] = kFar;
    touched_.clear();
    reached_.clear();
    heap_.clear();
    radius_ = radius;
    for (const std::uint32_t v : sources) offer(v, 0);
    while (!heap_.empty() && reached_.size() < kMost) {
        std::pop_heap(heap_.begin(), heap_.end(), farther);
        const Reached at = heap_.back();
        heap_.pop_back();
        if (at.distance > distance_[at.vertex]) continue;
        reached_.push_back(at);
        const Vec3& here = mesh_.positions[at.vertex];
        for (const HalfEdge h : corners_.at(at.vertex)) {
            for (const HalfEdge g : {next(h), prev(h)}) {
                const std::uint32_t other = origin(mesh_, g);
                offer(other, at.distance + (mesh_.positions[other] - here).norm());
            }
        }
    }
    return reached_;
}

}  // namespace vsplit

#include "features/crease_noise.h"

#include <cstdint>
#include <queue>
#include <utility>

#include "mesh/half_edges.h"

namespace vsplit {
namespace {

double length_of(const TriangleMesh& mesh, const SharpEdge& crease) {
    return (mesh.positions[crease.a] - mesh.positions[crease.b]).norm();
}

/// Creases as a graph that loses its short ends.
class Branches {
public:
    Branches(const std::vector<SharpEdge>& creases, const TriangleMesh& mesh, double least)
        : creases_(creases), mesh_(mesh), least_(least), gone_(creases.size(), false) {
        first_.assign(mesh.positions.size() + 1, 0);
        for (const SharpEdge& c : creases_) {
            ++first_[c.a + 1];
            ++first_[c.b + 1];
        }
        for (std::size_t v = 0; v + 1 < first_.size(); ++v) first_[v + 1] += first_[v];
        at_.resize(first_.back());
        std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
        for (std::uint32_t n = 0; n < creases_.size(); ++n) {
            at_[next[creases_[n].a]++] = n;
            at_[next[creases_[n].b]++] = n;
        }
    }

    void shorten() {
        for (std::uint32_t v = 0; v < mesh_.positions.size(); ++v) look_at(v);
        while (!short_.empty()) {
            const auto [length, end] = short_.top();
            short_.pop();
            const Branch branch = branch_from(end);
            if (branch.edges.empty() || branch.length >= least_) continue;
            if (branch.length > length) {  // grew since: another that met it has gone
                short_.emplace(branch.length, end);
                continue;
            }
            for (const std::uint32_t n : branch.edges) gone_[n] = true;
            look_at(branch.far_end);
        }
    }

    [[nodiscard]] bool gone(std::size_t n) const { return gone_[n]; }

private:
    struct Branch {
        std::vector<std::uint32_t> edges;  // none: no free end
        double length = 0;
        std::uint32_t far_end = 0;
    };
    using Entry = std::pair<double, std::uint32_t>;  // length, free end

    void look_at(std::uint32_t vertex) {
        const Branch branch = branch_from(vertex);
        if (!branch.edges.empty() && branch.length < least_) short_.emplace(branch.length, vertex);
    }

    /// The crease at `vertex` other than `from`, where that is the only one.
    [[nodiscard]] std::uint32_t only_crease(std::uint32_t vertex, std::uint32_t from) const {
        std::uint32_t found = kNone;
        for (std::uint32_t i = first_[vertex]; i < first_[vertex + 1]; ++i) {
            if (gone_[at_[i]] || at_[i] == from) continue;
            if (found != kNone) return kNone;
            found = at_[i];
        }
        return found;
    }

    /// From a free end to where it meets others, or until it is long enough.
    [[nodiscard]] Branch branch_from(std::uint32_t end) const {
        Branch branch;
        branch.far_end = end;
        for (std::uint32_t n = only_crease(end, kNone); n != kNone && branch.length < least_;
             n = only_crease(branch.far_end, n)) {
            const SharpEdge& c = creases_[n];
            branch.length += length_of(mesh_, c);
            branch.far_end = c.a == branch.far_end ? c.b : c.a;
            branch.edges.push_back(n);
        }
        return branch;
    }

    const std::vector<SharpEdge>& creases_;
    const TriangleMesh& mesh_;
    const double least_;
    std::vector<bool> gone_;
    std::vector<std::uint32_t> first_;  // of a vertex: where its creases start in at_
    std::vector<std::uint32_t> at_;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> short_;  // lengths may have grown since
};

/// Of the surface.
constexpr double kLeastShare = 0.02;

}  // namespace

std::vector<SharpEdge> without_noise(std::vector<SharpEdge> creases, const TriangleMesh& mesh, double least) {
    if (!(least > 0)) return creases;
    Branches branches(creases, mesh, least);
    branches.shorten();
    double lost = 0;
    std::vector<SharpEdge> kept;
    for (std::size_t n = 0; n < creases.size(); ++n) {
        if (branches.gone(n)) {
            lost += length_of(mesh, creases[n]);
        } else {
            kept.push_back(creases[n]);
        }
    }
    return lost * least < kLeastShare * surface_area(mesh) ? creases : kept;
}

}  // namespace vsplit

#include "vsplit/features/normal_voting.h"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "features/mean_edge.h"
#include "features/neighbourhood.h"

namespace vsplit {
namespace {

/// sigma of the votes' weight, as a share of the radius: a face at the rim counts exp(-2).
constexpr double kSigmaShare = 0.5;
/// A vertex beside the crease sees less of its far side; this share of what one on it sees is enough.
constexpr double kBesideCrease = 0.4;

/// What the faces around a vertex voted for.
struct Ballot {
    Vec3 normal = Vec3::Zero();
    double surface = 0;  // l1 - l2, of a tensor of trace 1
    double crease = 0;   // l2 - l3
    double corner = 0;   // l3
};

/// The normal at `to` of the circle through `from` and `to` that has `normal` at `from`: votes from all over a sphere agree.
Vec3 carried(const Vec3& normal, const Vec3& from, const Vec3& to) {
    const Vec3 way = to - from;
    const double square = way.squaredNorm();
    return square > 0 ? Vec3(normal - 2 * normal.dot(way) / square * way) : normal;
}

Ballot count(const Eigen::Matrix3d& tensor, const Vec3& sum) {
    const double trace = tensor.trace();
    if (!(trace > 0)) return {};
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(tensor / trace);
    const Vec3& l = solver.eigenvalues();  // ascending
    Ballot ballot{solver.eigenvectors().col(2), l[2] - l[1], l[1] - l[0], std::max(l[0], 0.0)};
    if (ballot.normal.dot(sum) < 0) ballot.normal = -ballot.normal;
    return ballot;
}

class Voting {
public:
    Voting(const TriangleMesh& mesh, const FaceNormals& normals, double radius)
        : mesh_(mesh), normals_(normals.normals), corners_(mesh), radius_(radius * mean_edge(mesh)) {
        for (const Triangle& t : mesh.faces) {
            const Vec3& a = mesh.positions[t[0]];
            const Vec3& b = mesh.positions[t[1]];
            const Vec3& c = mesh.positions[t[2]];
            centroids_.emplace_back((a + b + c) / 3);
            // A face reaches out of the neighbourhood where it is larger than that.
            areas_.push_back(std::min((b - a).cross(c - a).norm() / 2, radius_ * radius_));
        }
    }

    [[nodiscard]] std::vector<Ballot> ballots() const {
        std::vector<Ballot> all(mesh_.positions.size());
        for_each(all.size(), [&](EdgePaths& paths, std::uint32_t v) { all[v] = ballot(paths, v); });
        return all;
    }

    [[nodiscard]] std::vector<Vec3> clearest(const std::vector<Ballot>& ballots) const {
        std::vector<Vec3> result(mesh_.faces.size());
        for_each(result.size(), [&](EdgePaths& paths, std::uint32_t f) { result[f] = listen(paths, ballots, f); });
        return result;
    }

private:
    template <class Work>
    void for_each(std::size_t count, const Work& work) const {
        tbb::enumerable_thread_specific<EdgePaths> paths([&] { return EdgePaths(mesh_, corners_); });
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 256), [&](const tbb::blocked_range<std::size_t>& range) {
            EdgePaths& own = paths.local();
            for (std::size_t i = range.begin(); i < range.end(); ++i) work(own, static_cast<std::uint32_t>(i));
        });
    }

    /// Mean distance of a face's corners; beyond the radius unless all are within, but for the faces at the centre itself.
    [[nodiscard]] double distance(const EdgePaths& paths, std::uint32_t face) const {
        double sum = 0;
        for (const std::uint32_t v : mesh_.faces[face]) sum += std::min(paths.distance(v), 3 * radius_);
        return sum / 3;
    }

    [[nodiscard]] Ballot ballot(EdgePaths& paths, std::uint32_t vertex) const {
        Eigen::Matrix3d tensor = Eigen::Matrix3d::Zero();
        Vec3 sum = Vec3::Zero();
        const auto reached = paths.search({&vertex, 1}, radius_);
        const Vec3& here = mesh_.positions[vertex];
        for (std::size_t i = 0; i < reached.size(); ++i) {
            for (const HalfEdge h : corners_.at(reached[i].vertex)) {
                const std::uint32_t f = face_of(h);
                if (!first_to_reach(paths, reached[i].vertex, f)) continue;
                const double g = distance(paths, f);
                if (g > radius_ && i > 0) continue;
                const Vec3 vote = carried(normals_[f], centroids_[f], here);
                const double weight = areas_[f] * std::exp(-g / (kSigmaShare * radius_));
                tensor += weight * vote * vote.transpose();
                sum += weight * vote;
            }
        }
        return count(tensor, sum);
    }

    /// Whether a face's corner is the one it is counted at: its nearest, ties by number.
    [[nodiscard]] bool first_to_reach(const EdgePaths& paths, std::uint32_t vertex, std::uint32_t face) const {
        const double own = paths.distance(vertex);
        for (const std::uint32_t v : mesh_.faces[face]) {
            const double other = paths.distance(v);
            if (other < own || (other == own && v < vertex)) return false;
        }
        return true;
    }

    [[nodiscard]] Vec3 listen(EdgePaths& paths, const std::vector<Ballot>& ballots, std::uint32_t face) const {
        Vec3 best = normals_[face];
        double best_score = 0;
        for (const auto& [distance, v] : paths.search(mesh_.faces[face], radius_)) {
            const Vec3 normal = carried(ballots[v].normal, mesh_.positions[v], centroids_[face]);
            const double score = ballots[v].surface * normal.dot(normals_[face]);
            if (score <= best_score) continue;
            best_score = score;
            best = normal;
        }
        return best;
    }

    const TriangleMesh& mesh_;
    const std::vector<Vec3>& normals_;
    VertexCorners corners_;
    double radius_;
    std::vector<Vec3> centroids_;
    std::vector<double> areas_;
};

VertexKind kind_of(const Ballot& ballot, double least) {
    if (ballot.corner > least) return VertexKind::kCorner;
    return ballot.crease > kBesideCrease * least ? VertexKind::kCrease : VertexKind::kSurface;
}

}  // namespace

VotedNormals vote_normals(const TriangleMesh& mesh, const FaceNormals& normals, const NormalVotingOptions& options) {
    const Voting voting(mesh, normals, options.radius);
    const std::vector<Ballot> ballots = voting.ballots();
    VotedNormals result;
    result.normals = voting.clearest(ballots);
    // Two halves that meet at an angle t make a tensor with eigenvalues cos^2(t/2), sin^2(t/2), 0.
    const double half = std::sin(std::min(options.angle, 90.0) * std::numbers::pi / 360);
    result.vertices.reserve(ballots.size());
    for (const Ballot& ballot : ballots) result.vertices.push_back(kind_of(ballot, half * half));
    return result;
}

}  // namespace vsplit

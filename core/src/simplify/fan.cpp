#include "simplify/fan.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "quality/face_shape.h"

// The loops below have no order-dependent sums and multiply-add never fuses (-ffp-contract=off), so that every clone gives the
// same bits. Sanitizers run before the loader's choice between clones can be made.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)
#define VSPLIT_VECTOR_CLONES __attribute__((target_clones("avx2", "default")))
#else
#define VSPLIT_VECTOR_CLONES
#endif

// The columns of a fan never overlap, which the compiler cannot see.
#if defined(__clang__)
#pragma clang diagnostic ignored "-Wpass-failed"  // without optimisation, or under sanitizers, loops stay as they are
#define VSPLIT_INDEPENDENT_STEPS _Pragma("clang loop vectorize(assume_safety)")
#elif defined(__GNUC__)
#define VSPLIT_INDEPENDENT_STEPS _Pragma("GCC ivdep")
#else
#define VSPLIT_INDEPENDENT_STEPS
#endif

namespace vsplit {
namespace {

/// Loops run on to a whole number of vectors, over whatever stands behind the end: the columns are long enough, and a remainder
/// done one by one would take as long as the rest.
constexpr std::size_t kLanes = 4;
std::size_t whole_vectors(std::size_t count) { return (count + kLanes - 1) / kLanes * kLanes; }

/// A face may turn by at most acos of this: 78 degrees.
constexpr double kLeastTurnCosine = 0.2;

/// Edge lengths along the ring.
VSPLIT_VECTOR_CLONES void ring_lengths(std::size_t n, const double* __restrict x, const double* __restrict y,
                                       const double* __restrict z, double* __restrict length) {
    VSPLIT_INDEPENDENT_STEPS
    for (std::size_t t = 0; t < n; ++t) {
        const double dx = x[t + 1] - x[t];
        const double dy = y[t + 1] - y[t];
        const double dz = z[t + 1] - z[t];
        length[t] = std::sqrt(dx * dx + dy * dy + dz * dz);
    }
}

struct Spokes {
    double* __restrict x;
    double* __restrict y;
    double* __restrict z;
    double* __restrict length;
};

/// Vectors from (px, py, pz) to the ring and their lengths; one more than faces.
VSPLIT_VECTOR_CLONES void spokes_from(double px, double py, double pz, std::size_t count, const double* __restrict x,
                                      const double* __restrict y, const double* __restrict z, const Spokes& out) {
    VSPLIT_INDEPENDENT_STEPS
    for (std::size_t t = 0; t < count; ++t) {
        const double dx = x[t] - px;
        const double dy = y[t] - py;
        const double dz = z[t] - pz;
        out.x[t] = dx;
        out.y[t] = dy;
        out.z[t] = dz;
        out.length[t] = std::sqrt(dx * dx + dy * dy + dz * dz);
    }
}

struct FanIn {
    const double* __restrict x;
    const double* __restrict y;
    const double* __restrict z;
    const double* __restrict spoke;
    const double* __restrict ring;
    const double* __restrict old_nx;
    const double* __restrict old_ny;
    const double* __restrict old_nz;
};

struct FanOut {
    double* __restrict stretch;
    double* __restrict size;
    double* __restrict folded;  // > 0 where the face turned too far
};

/// Stretch and size of each face of the fan, and whether it folds over.
VSPLIT_VECTOR_CLONES void fan_faces(std::size_t n, const FanIn& in, const FanOut& out) {
    VSPLIT_INDEPENDENT_STEPS
    for (std::size_t t = 0; t < n; ++t) {
        const double cx = in.y[t] * in.z[t + 1] - in.z[t] * in.y[t + 1];
        const double cy = in.z[t] * in.x[t + 1] - in.x[t] * in.z[t + 1];
        const double cz = in.x[t] * in.y[t + 1] - in.y[t] * in.x[t + 1];
        const double twice_area = std::sqrt(cx * cx + cy * cy + cz * cz);
        const double a = in.spoke[t];
        const double b = in.ring[t];
        const double c = in.spoke[t + 1];
        const double ab = a > b ? a : b;
        const double longest = ab > c ? ab : c;
        const double denominator = (a + b + c) * longest;
        out.stretch[t] = kSqrt12 * twice_area / (denominator > 0 ? denominator : 1);
        out.size[t] = longest;
        out.folded[t] = kLeastTurnCosine * twice_area - (cx * in.old_nx[t] + cy * in.old_ny[t] + cz * in.old_nz[t]);
    }
}

}  // namespace

void Fan::close(std::size_t faces) {
    size_ = faces;
    ring_size_ = faces;
    x_[size_] = x_[0];
    y_[size_] = y_[0];
    z_[size_] = z_[0];
    ring_lengths(whole_vectors(size_), x_.data(), y_.data(), z_.data(), ring_length_.data());
}

void Fan::open_at(std::uint32_t ghost, std::size_t count) {
    const auto at = std::find(vertex_.begin(), vertex_.begin() + count, ghost) - vertex_.begin();
    const auto turn = [at, count](auto& column) {
        std::rotate(column.begin(), column.begin() + (at + 1) % static_cast<std::ptrdiff_t>(count), column.begin() + count);
    };
    turn(vertex_);
    turn(face_);
    for (Column* column : {&x_, &y_, &z_, &old_nx_, &old_ny_, &old_nz_}) turn(*column);
    ring_size_ = count - 1;
    size_ = count - 2;
    ring_lengths(whole_vectors(size_), x_.data(), y_.data(), z_.data(), ring_length_.data());
}

double Fan::defect() const {
    double sum = 0;
    for (std::size_t t = 0; t < size_; ++t) sum += (1 - stretch_[t]) * (1 - stretch_[t]);
    return sum / static_cast<double>(size_);
}

Excess Fan::excess(const FaceBounds& bounds, const Vec3& apex, std::size_t first, std::size_t last) const {
    Excess all;
    for (std::size_t t = first; t < last; ++t) all.add(bounds.excess({apex, ring(t), ring(t + 1)}));
    return all;
}

Vec3 Fan::centroid() const {
    Vec3 sum = Vec3::Zero();
    for (std::size_t t = 0; t < ring_size_; ++t) sum += Vec3(x_[t], y_[t], z_[t]);
    return sum / static_cast<double>(ring_size_);
}

Fan::Shape Fan::shape_at(const Vec3& position) {
    spokes_from(position.x(), position.y(), position.z(), whole_vectors(size_ + 1), x_.data(), y_.data(), z_.data(),
                {spoke_x_.data(), spoke_y_.data(), spoke_z_.data(), spoke_length_.data()});
    fan_faces(whole_vectors(size_),
              {spoke_x_.data(), spoke_y_.data(), spoke_z_.data(), spoke_length_.data(), ring_length_.data(), old_nx_.data(),
               old_ny_.data(), old_nz_.data()},
              {stretch_.data(), face_size_.data(), folded_.data()});
    Shape shape{stretch_[0], 0, 0, false};
    for (std::size_t t = 0; t < size_; ++t) {
        shape.stretch_min = std::min(shape.stretch_min, stretch_[t]);
        shape.stretch_sum += stretch_[t];
        shape.size_max = std::max(shape.size_max, face_size_[t]);
        shape.folds |= !(folded_[t] <= 0);
    }
    shape.folds |= !(shape.stretch_min > 0);
    return shape;
}

Eigen::Vector3f Fan::normal(std::size_t t) const {
    const Vec3 left(spoke_x_[t], spoke_y_[t], spoke_z_[t]);
    const Vec3 right(spoke_x_[t + 1], spoke_y_[t + 1], spoke_z_[t + 1]);
    return left.cross(right).normalized().cast<float>();
}

}  // namespace vsplit

#include "simplify/fan.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <utility>

namespace vsplit {

void Fan::close(std::size_t faces) {
    size_ = faces;
    ring_size_ = faces;
    columns_.x[faces] = columns_.x[0];
    columns_.y[faces] = columns_.y[0];
    columns_.z[faces] = columns_.z[0];
    is_measured_ = false;
}

void Fan::open_at(std::uint32_t ghost, std::size_t count) {
    const auto at = std::find(vertex_.begin(), vertex_.begin() + count, ghost) - vertex_.begin();
    const auto turn = [at, count](auto& column) {
        std::rotate(column.begin(), column.begin() + (at + 1) % static_cast<std::ptrdiff_t>(count), column.begin() + count);
    };
    turn(vertex_);
    turn(face_);
    for (auto* column : {&columns_.x, &columns_.y, &columns_.z}) turn(*column);
    for (auto* column : {&columns_.old_nx, &columns_.old_ny, &columns_.old_nz}) turn(*column);
    ring_size_ = count - 1;
    size_ = count - 2;
    is_measured_ = false;
}

double Fan::defect() const {
    double sum = 0;
    for (std::size_t t = 0; t < size_; ++t) sum += (1 - stretch(t)) * (1 - stretch(t));
    return sum / static_cast<double>(size_);
}

Excess Fan::excess(const FaceBounds& bounds, const Vec3& apex, std::size_t first, std::size_t last) const {
    Excess all;
    for (std::size_t t = first; t < last; ++t) all.add(bounds.excess({apex, ring(t), ring(t + 1)}));
    return all;
}

Vec3 Fan::centroid() const {
    Vec3 sum = Vec3::Zero();
    for (std::size_t t = 0; t < ring_size_; ++t) sum += ring(t);
    return sum / static_cast<double>(ring_size_);
}

Fan::Shape Fan::shape_at(const Vec3& position) {
    apex_ = position;
    const bool measure = !std::exchange(is_measured_, true);
    return shape_fan(columns_, size_, position, measure);
}

Eigen::Vector3f Fan::normal(std::size_t t) const {
    const Vec3 left = ring(t) - apex_;
    const Vec3 right = ring(t + 1) - apex_;
    return left.cross(right).normalized().cast<float>();
}

}  // namespace vsplit

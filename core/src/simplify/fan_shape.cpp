#include "simplify/fan_shape.h"

#include "quality/face_shape.h"

// Highway compiles what stands between HWY_BEFORE_NAMESPACE and HWY_AFTER_NAMESPACE once for each kind of vector and chooses when
// the program runs. No sum here depends on how many lanes there are, and no multiply-add fuses (-ffp-contract=off): every kind
// gives the same bits.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "simplify/fan_shape.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace vsplit::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
// Most fans have 8 to 12 faces: eight lanes would idle as often as not.
using Tag = hn::CappedTag<double, 4>;
using Lanes = hn::Vec<Tag>;
constexpr std::size_t kLanes = hn::MaxLanes(Tag());

HWY_INLINE Lanes length_of(Lanes x, Lanes y, Lanes z) {
    return hn::Sqrt(hn::Add(hn::Add(hn::Mul(x, x), hn::Mul(y, y)), hn::Mul(z, z)));
}

/// The lanes after the first of `low`, then the first of `high`.
HWY_INLINE Lanes next_lanes(Lanes low, Lanes high) {
#if HWY_TARGET == HWY_SCALAR
    static_cast<void>(low);
    return high;
#else
    const Tag d;
    if constexpr (kLanes == 4) return hn::CombineShiftRightBytes<sizeof(double)>(d, hn::ConcatLowerUpper(d, high, low), low);
    return hn::CombineShiftRightBytes<sizeof(double)>(d, high, low);
#endif
}

HWY_INLINE Lanes load_floats(const float* from) {
    const hn::Rebind<float, Tag> floats;
    return hn::PromoteTo(Tag(), hn::LoadU(floats, from));
}

struct Spokes {
    Lanes x, y, z, length;
};

HWY_INLINE Spokes next_spokes(const Spokes& low, const Spokes& high) {
    return {next_lanes(low.x, high.x), next_lanes(low.y, high.y), next_lanes(low.z, high.z), next_lanes(low.length, high.length)};
}

/// What there is of the shape, by lanes.
struct Extremes {
    Lanes stretch_min, size_max, turn;  // turn: most of kLeastTurnCosine - cosine, times the area
};

class Evaluation {
public:
    HWY_INLINE Evaluation(FanColumns& fan, std::size_t faces, const Vec3& apex)
        : fan_(fan), faces_(faces), x_(hn::Set(Tag(), apex.x())), y_(hn::Set(Tag(), apex.y())), z_(hn::Set(Tag(), apex.z())) {}

    HWY_INLINE FanShape run() {
        const Tag d;
        Extremes all{hn::Set(d, 2.0), hn::Zero(d), hn::Set(d, -1.0)};  // no stretch is over 1 by more than rounding
        double sum = 0;
        Spokes left = spokes(0);
        for (std::size_t t = 0; t < faces_; t += kLanes) {
            const Spokes after = spokes(t + kLanes);
            add_faces(t, left, next_spokes(left, after), all);
            // In order: a sum by lanes would depend on their number. Lanes beyond the last face hold nothing.
            for (std::size_t lane = 0; lane < kLanes; ++lane) sum += fan_.stretch[t + lane];
            left = after;
        }
        const double least = hn::GetLane(hn::MinOfLanes(d, all.stretch_min));
        const bool folds = !(hn::GetLane(hn::MaxOfLanes(d, all.turn)) <= 0) || !(least > 0);
        return {least, sum, hn::GetLane(hn::MaxOfLanes(d, all.size_max)), folds};
    }

private:
    HWY_INLINE Spokes spokes(std::size_t t) const {
        const Tag d;
        const Lanes x = hn::Sub(hn::LoadU(d, &fan_.x[t]), x_);
        const Lanes y = hn::Sub(hn::LoadU(d, &fan_.y[t]), y_);
        const Lanes z = hn::Sub(hn::LoadU(d, &fan_.z[t]), z_);
        const Lanes length = length_of(x, y, z);
        hn::StoreU(length, d, &fan_.spoke[t]);
        return {x, y, z, length};
    }

    /// Faces t to t + kLanes.
    HWY_INLINE void add_faces(std::size_t t, const Spokes& a, const Spokes& b, Extremes& all) {
        const Tag d;
        const Lanes cx = hn::Sub(hn::Mul(a.y, b.z), hn::Mul(a.z, b.y));
        const Lanes cy = hn::Sub(hn::Mul(a.z, b.x), hn::Mul(a.x, b.z));
        const Lanes cz = hn::Sub(hn::Mul(a.x, b.y), hn::Mul(a.y, b.x));
        const Lanes twice_area = length_of(cx, cy, cz);
        const Lanes ring = hn::LoadU(d, &fan_.ring[t]);
        // As stretch_of has it.
        const Lanes longest = hn::Max(hn::Max(a.length, ring), b.length);
        const Lanes denominator = hn::Mul(hn::Add(hn::Add(a.length, ring), b.length), longest);
        const Lanes divisor = hn::IfThenElse(hn::Gt(denominator, hn::Zero(d)), denominator, hn::Set(d, 1.0));
        const Lanes stretch = hn::Div(hn::Mul(hn::Set(d, kSqrt12), twice_area), divisor);
        const Lanes along = hn::Add(hn::Add(hn::Mul(cx, load_floats(&fan_.old_nx[t])), hn::Mul(cy, load_floats(&fan_.old_ny[t]))),
                                    hn::Mul(cz, load_floats(&fan_.old_nz[t])));
        const Lanes turn = hn::Sub(hn::Mul(hn::Set(d, kLeastTurnCosine), twice_area), along);
        const auto there = hn::FirstN(d, faces_ - t);
        hn::StoreU(hn::IfThenElseZero(there, stretch), d, &fan_.stretch[t]);
        hn::StoreU(longest, d, &fan_.face_size[t]);
        all.stretch_min = hn::Min(all.stretch_min, hn::IfThenElse(there, stretch, all.stretch_min));
        all.size_max = hn::Max(all.size_max, hn::IfThenElseZero(there, longest));
        all.turn = hn::Max(all.turn, hn::IfThenElse(there, turn, all.turn));
    }

    FanColumns& fan_;
    const std::size_t faces_;
    const Lanes x_, y_, z_;
};

HWY_INLINE void measure_ring(FanColumns& fan, std::size_t faces) {
    const Tag d;
    for (std::size_t t = 0; t < faces; t += kLanes) {
        const Lanes dx = hn::Sub(hn::LoadU(d, &fan.x[t + 1]), hn::LoadU(d, &fan.x[t]));
        const Lanes dy = hn::Sub(hn::LoadU(d, &fan.y[t + 1]), hn::LoadU(d, &fan.y[t]));
        const Lanes dz = hn::Sub(hn::LoadU(d, &fan.z[t + 1]), hn::LoadU(d, &fan.z[t]));
        hn::StoreU(length_of(dx, dy, dz), d, &fan.ring[t]);
    }
}

FanShape shape_of(FanColumns& fan, std::size_t faces, const Vec3& apex, bool measure) {
    if (measure) measure_ring(fan, faces);
    return Evaluation(fan, faces, apex).run();
}

}  // namespace
}  // namespace vsplit::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace vsplit {

HWY_EXPORT(shape_of);

FanShape shape_fan(FanColumns& fan, std::size_t faces, const Vec3& apex, bool measure) {
    return HWY_DYNAMIC_DISPATCH(shape_of)(fan, faces, apex, measure);
}

std::vector<std::int64_t> simd_paths() { return hwy::SupportedAndGeneratedTargets(); }
const char* simd_path_name(std::int64_t path) { return hwy::TargetName(path); }
void use_simd_path(std::int64_t path) {
    hwy::SetSupportedTargetsForTest(path);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

}  // namespace vsplit
#endif

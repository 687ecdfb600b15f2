#include "simplify/fan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/core/random.h"
#include "vsplit/quality/stretch.h"

namespace vsplit::test {
namespace {

TEST(FanTest, AnOpenRingIsWhatIsLeftWithoutTheGhost) {
    Random random(5);
    for (std::uint32_t count = 3; count <= Fan::kCapacity; ++count) {
        const std::uint32_t ghost_at = random.below(count);
        Fan fan;
        std::vector<Vec3> ring(count);
        for (std::uint32_t t = 0; t < count; ++t) {
            const double angle = 2 * std::acos(-1.0) * t / count;
            ring[t] = Vec3(std::cos(angle), std::sin(angle), 0) * random.uniform(0.8, 1.2);
            fan.put(t, t == ghost_at ? 0 : 100 + t, ring[t], 200 + t, Eigen::Vector3f(0, 0, 1));
        }
        fan.open_at(0, count);
        ASSERT_TRUE(fan.is_open());
        ASSERT_EQ(fan.size(), count - 2);
        ASSERT_EQ(fan.ring_size(), count - 1);
        const Vec3 apex(0.01, 0.02, 0);
        const Fan::Shape shape = fan.shape_at(apex);
        double least = 2, sum = 0;
        Vec3 centroid = Vec3::Zero();
        for (std::uint32_t n = 0; n + 1 < count; ++n) {
            const std::uint32_t t = (ghost_at + 1 + n) % count;
            EXPECT_EQ(fan.vertex(n), 100 + t);
            EXPECT_EQ(fan.ring(n), ring[t]);
            centroid += ring[t] / (count - 1);
            if (n + 2 == count) continue;  // the last has no face
            EXPECT_EQ(fan.face(n), 200 + t);
            const double s = stretch(apex, ring[t], ring[(t + 1) % count]);
            EXPECT_NEAR(fan.stretch(n), s, 1e-12);
            least = std::min(least, s);
            sum += s;
        }
        EXPECT_NEAR(shape.stretch_min, least, 1e-12);
        EXPECT_NEAR(shape.stretch_sum, sum, 1e-12 * count);
        EXPECT_NEAR((fan.centroid() - centroid).norm(), 0, 1e-12);
    }
}

}  // namespace
}  // namespace vsplit::test

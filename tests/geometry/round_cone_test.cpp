#include "geometry/round_cone.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace acinus::geometry {
namespace {

/// Cones of every shape, also such that one end holds the other: the distance to the wall is the
/// least over all balls, and prepared cones give the same.
TEST(ConeWall, DistanceIsTheLeastOverAllBalls) {
  constexpr int kCones = 300, kBalls = 4000;
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> uniform;
  const auto draw = [&](double half) {
    const double x = uniform(random), y = uniform(random), z = uniform(random);
    return Vec3(half * (2 * Vec3(x, y, z) - Vec3::Ones()));
  };
  int held = 0;
  for (int k = 0; k < kCones; ++k) {
    const Vec3 a = draw(2), b = draw(2), x = draw(5);
    const double ra = 3 * uniform(random), rb = 3 * uniform(random);
    held += (b - a).norm() <= std::abs(rb - ra) ? 1 : 0;
    double least = 1e300;
    for (int i = 0; i <= kBalls; ++i) {
      const double t = static_cast<double>(i) / kBalls;
      least = std::min(least, (x - (a + t * (b - a))).norm() - (ra + t * (rb - ra)));
    }
    const NearestBall ball = find_nearest_ball(x, a, b, ra, rb);
    const double distance = ball.apart.norm() - ball.radius;
    EXPECT_LE(distance, least + 1e-12) << k;
    EXPECT_NEAR(distance, least, 1e-5) << k;
    EXPECT_NEAR(ConeWall(a, b, ra, rb).distance(x), distance, 1e-12) << k;
  }
  EXPECT_GT(held, 10);
}

}  // namespace
}  // namespace acinus::geometry

/// Values and gradients between voxels.

#include "substances/sample.hpp"

#include <gtest/gtest.h>

#include "tests/substances/fields.hpp"

namespace acinus::substances {
namespace {

TEST(Sample, LinearFieldsAreExact) {
  const VoxelGrid g = make_grid({Vec3(-10, 0, 5), Vec3(40, 30, 60)}, 4.3);
  const Vec3 slope(0.3, -0.2, 0.7);
  const std::vector<double> c = sample(g, [&](const Vec3& x) { return 2 + slope.dot(x); });
  for (const Vec3& x : {Vec3(3, 7, 20), Vec3(-4, 25, 33.3), Vec3(21, 14, 50)}) {
    EXPECT_NEAR(interpolate(g, c, x), 2 + slope.dot(x), 1e-12 * 50);
    EXPECT_LT((gradient_at(g, c, x) - slope).norm(), 1e-12 * 50);
  }
  // Outside, the gradient is that of the nearest pair of voxels.
  EXPECT_LT((gradient_at(g, c, Vec3(-100, 15, 30)) - slope).norm(), 1e-12 * 50);
}

TEST(Sample, GradientIsOfSecondOrder) {
  const auto error = [](int n) {
    const VoxelGrid g = cube(100, n);
    const std::vector<double> c = sample(g, [](const Vec3& x) { return std::sin(0.05 * x.x()); });
    const Vec3 x(40.3, 51.7, 62.1);
    return std::abs(gradient_at(g, c, x).x() - 0.05 * std::cos(0.05 * x.x()));
  };
  EXPECT_LT(error(80), 0.2 * error(20));
  EXPECT_LT(error(80), 1e-4);
}

TEST(Sample, GridOfOneVoxelHasNoGradient) {
  const VoxelGrid g = cube(10, 1);
  const std::vector<double> c{4};
  EXPECT_EQ(gradient_at(g, c, Vec3(1, 2, 3)), Vec3(0, 0, 0));
  EXPECT_EQ(interpolate(g, c, Vec3(1, 2, 3)), 4);
}

}  // namespace
}  // namespace acinus::substances

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

TEST(ExtendedField, KeepsItsPlaceAndHasTheValuesOutside) {
  const VoxelGrid g = make_grid({Vec3(-10, 0, 5), Vec3(40, 30, 60)}, 4.3);
  const auto linear = [](const Vec3& x) { return 100 + x.x() + 2 * x.y() - 3 * x.z(); };
  const Layers layers{2, 0, 0, 3, 1, 1};
  const VoxelGrid wide = extend_grid(g, layers);
  EXPECT_EQ(wide.spacing, g.spacing);
  EXPECT_EQ(wide.n, (std::array{g.n[0] + 2, g.n[1] + 3, g.n[2] + 2}));
  const std::vector<double> c = extend_field(g, layers, sample(g, linear), {1, 2, 3, 4, 5, 6});
  ASSERT_EQ(c.size(), wide.n_voxel());
  int inside = 0;
  for (int k = 0; k < wide.n[2]; ++k)
    for (int j = 0; j < wide.n[1]; ++j)
      for (int i = 0; i < wide.n[0]; ++i) {
        const Vec3 x = wide.center(i, j, k);
        const double value = c[wide.index(i, j, k)];
        if (k == 0 || k == wide.n[2] - 1) {
          EXPECT_EQ(value, k == 0 ? 5 : 6);
        } else if (j >= g.n[1]) {
          EXPECT_EQ(value, 4);
        } else if (i < 2) {
          EXPECT_EQ(value, 1);
        } else {
          EXPECT_NEAR(value, linear(x), 1e-9);
          ++inside;
        }
      }
  EXPECT_EQ(inside, static_cast<int>(g.n_voxel()));
}

}  // namespace
}  // namespace acinus::substances

#include "imaging/distance.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace acinus::imaging {
namespace {

Grid make_grid(const Voxel& size, const Vec3& voxel) {
  Grid g;
  g.size = size;
  g.voxel = voxel;
  g.origin = Vec3(1, 2, 3);
  return g;
}

Vec3 place(const Grid& g, std::size_t at) {
  const std::size_t x = at % g.size[0], row = at / g.size[0];
  return g.origin + g.voxel.cwiseProduct(Vec3(x, row % g.size[1], row / g.size[1]));
}

TEST(SignedDistance, IsThatOfAllPairs) {
  std::mt19937 random(2);
  for (const Vec3& voxel : {Vec3(1, 1, 1), Vec3(0.5, 0.7, 2)})
    for (const unsigned share : {2u, 30u}) {
      Grid g = make_grid({9, 8, 7}, voxel);
      std::vector<std::uint8_t> inside(9 * 8 * 7);
      for (auto& i : inside) i = random() % share == 0;
      compute_signed_distance(inside, g);
      for (std::size_t a = 0; a < inside.size(); ++a) {
        double nearest = 1e300;
        for (std::size_t b = 0; b < inside.size(); ++b)
          if (inside[a] != inside[b])
            nearest = std::min(nearest, (place(g, a) - place(g, b)).norm());
        EXPECT_NEAR(g.value[a], inside[a] != 0 ? -nearest : nearest, 1e-12);
      }
    }
}

TEST(Grid, IsExactForLinearFunctions) {
  Grid g = make_grid({4, 5, 6}, {0.5, 1, 2});
  const auto f = [](const Vec3& x) { return 3 + 2 * x[0] - x[1] + 0.5 * x[2]; };
  for (std::size_t k = 0; k < 4 * 5 * 6; ++k) g.value.push_back(f(place(g, k)));
  for (const Vec3& x : {Vec3(1.2, 3.3, 7.7), Vec3(2.5, 6, 13), Vec3(1, 2, 3)})
    EXPECT_NEAR(g.at(x), f(x), 1e-12);
  EXPECT_NEAR(g.at(Vec3(-9, 3, 5)), f(Vec3(1, 3, 5)), 1e-12);
  EXPECT_NEAR(compute_largest_slope(g), Vec3(2, -1, 0.5).norm(), 1e-12);
  smooth(Vec3(0, 1, 0), g);  // keeps linear functions away from the ends
  EXPECT_NEAR(g.at(Vec3(1.2, 4, 7.7)), f(Vec3(1.2, 4, 7.7)), 0.1);
}

}  // namespace
}  // namespace acinus::imaging

/// Measures of adhesion of deformable cells.

#include "coupling/measure/adhesion.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "coupling/measure/measure.hpp"
#include "tests/coupling/worlds.hpp"

namespace acinus::coupling {
namespace {

Adhesion adhesion_at(double apart, int n_node, bool& any) {
  World world = make_test_world({{Vec3::Zero()}, {Vec3(apart, 0, 0)}}, 60, n_node);
  SizedWorkspace work(world);
  observe(world, work);
  any = any_adhesion(world, work);
  return measure_adhesion(world, work);
}

// Two spheres of radius R with their surfaces a gap g apart are closer than h within
// rho^2 = R (h - g). A mesh wobbles by its edge, a third of which is the range.
TEST(Adhesion, OfRestingSpheresIsTheCapWithinReach) {
  const geometry::Topology& mesh = geometry::shared_icosphere(642);
  const double range = 0.3 * mesh.mean_rest_length * 12;
  bool any = false;
  const Adhesion a = adhesion_at(24, 642, any);
  EXPECT_TRUE(any);
  EXPECT_NEAR(a.area, kPi * 12 * range, 0.15 * kPi * 12 * range);
  EXPECT_EQ(a.node.size(), 2u * 642u);
  // Nodes lie in the cap, or one edge beside it.
  const auto n = static_cast<double>(std::ranges::count(a.node, 1));
  EXPECT_GT(n / 2, a.area / (mesh.rest_area * 144 / 642));
  EXPECT_LT(n / 2, 3 * a.area / (mesh.rest_area * 144 / 642));
}

TEST(Adhesion, EndsBeyondTheRange) {
  const double range = 0.3 * geometry::shared_icosphere(162).mean_rest_length * 12;
  bool any = true;
  const Adhesion a = adhesion_at(24.4 + range, 162, any);
  EXPECT_FALSE(any);
  EXPECT_EQ(a.area, 0);
  EXPECT_EQ(std::ranges::count(a.node, 1), 0);
}

}  // namespace
}  // namespace acinus::coupling

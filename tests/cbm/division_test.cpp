#include "cbm/division.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "tests/cbm/spheres.hpp"
#include "tests/reference/sample.hpp"

namespace acinus::cbm {
namespace {

using reference::kEps;

TEST(Division, DaughtersFillHalfTheMotherEachAndTouchItFromInside) {
  auto random = reference::stream(70);
  for (int k = 0; k < 50; ++k) {
    Mother m;
    m.center = reference::random_vector(random, 300);
    m.radius = random.uniform(5, 20);
    m.direction = random.unit_vector();
    const DaughterSpheres d = divide(m);
    EXPECT_NEAR(2 * std::pow(d.radius, 3), std::pow(m.radius, 3), 8 * kEps * std::pow(m.radius, 3));
    // positions of 300 um carry eps of their own
    const double tolerance = 8 * kEps * (300 * std::sqrt(3.0) + m.radius);
    EXPECT_LT((0.5 * (d.center[0] + d.center[1]) - m.center).norm(), tolerance);
    for (const Vec3& x : d.center)
      EXPECT_NEAR((x - m.center).norm() + d.radius, m.radius, tolerance);
    EXPECT_GT((d.center[0] - d.center[1]).dot(m.direction), 0.5 * d.radius);
  }
}

TEST(Division, SeparationIsAShareOfTheLargestDistance) {
  Mother m{.center = {1, 2, 3}, .radius = 15, .direction = Vec3::UnitZ()};
  const double farthest = (divide(m).center[0] - divide(m).center[1]).norm();
  EXPECT_NEAR(farthest, 2 * 15 * (1 - 1 / std::cbrt(2.0)), 1e-14);
  m.separation = 0.4;
  EXPECT_NEAR((divide(m).center[0] - divide(m).center[1]).norm(), 0.4 * farthest, 1e-14);
  m.separation = 0;
  EXPECT_EQ(divide(m).center[0], m.center);
  EXPECT_EQ(divide(m).center[1], m.center);
}

TEST(Division, StrengthRisesFromNoneToAllOverTheRamp) {
  const DaughterSpheres d = divide({.radius = 15, .time = 1000, .ramp_duration = 8640});
  EXPECT_EQ(d.strength.at(1000), 0);
  EXPECT_DOUBLE_EQ(d.strength.at(1000 + 2160), 0.25);
  EXPECT_EQ(d.strength.at(1000 + 8640), 1);
  const DaughterSpheres at_once = divide({.radius = 15, .time = 1000, .ramp_duration = 0});
  EXPECT_EQ(at_once.strength.at(1000), 1);
}

TEST(Division, DaughtersPushEachOtherAlikeAndFarLessThanAtFullStrength) {
  const DaughterSpheres d = divide({.center = {5, 6, 7},
                                    .radius = 12 * std::cbrt(2.0),
                                    .direction = Vec3(1, 2, 2) / 3,
                                    .time = 0,
                                    .ramp_duration = 8640});
  std::vector<NewCell> cells{sphere(d.center[0], d.radius), sphere(d.center[1], d.radius)};
  Spheres full(cells);
  for (NewCell& c : cells) c.strength = d.strength;
  Spheres born(cells);
  full.find();
  born.time = 60;
  born.find();
  const double share = 60.0 / 8640;
  std::printf("daughters %.2f um apart push with %.3f nN after 60 s, %.1f nN at full strength\n",
              (d.center[0] - d.center[1]).norm(), born.force(0).norm(), full.force(0).norm());
  EXPECT_EQ(born.force(0) + born.force(1), Vec3::Zero());
  EXPECT_LT((born.force(0) - share * full.force(0)).norm(), 8 * kEps * full.force(0).norm());
  EXPECT_GT(born.force(0).dot(d.center[0] - d.center[1]), 0);
  born.time = 0;
  born.find();
  EXPECT_EQ(born.force(0).norm(), 0);
  EXPECT_TRUE(born.work.touching.empty());
}

}  // namespace
}  // namespace acinus::cbm

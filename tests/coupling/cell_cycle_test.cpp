#include "coupling/life/cell_cycle.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "tests/coupling/lives.hpp"

namespace acinus::coupling {
namespace {

constexpr double kCycleRoundOff = 1e-13;  // a few operations, relative

TEST(CellCycle, DoublesTheVolumeInTheCycleTimeAtAConstantRate) {
  Cycle c;
  c.birth_volume = kBirthVolume;
  c.duration = kDay;
  const Ramp r = growth_from(c, kBirthVolume, 100, 1);
  // 4/3 pi (12 um)^3 / 24 h = 8.37758e-20 m^3/s, Eq. (18)
  for (double time : {100.0, 3700.0, 50000.0})
    EXPECT_NEAR((r.at(time + 3600) - r.at(time)) / 3600, 8.37758e-2, 1e-7);
  EXPECT_NEAR(r.at(100 + kDay), 2 * kBirthVolume, kCycleRoundOff * kBirthVolume);
  EXPECT_EQ(r.at(100 + 2 * kDay), 2 * c.birth_volume) << "not beyond";
  const Ramp half = growth_from(c, 1.5 * kBirthVolume, 7, 0.5);
  EXPECT_EQ(half.at(7), 1.5 * kBirthVolume);
  EXPECT_NEAR(half.end, 7 + kDay, kCycleRoundOff * kDay) << "half the way at half the speed";
  const Ramp none = growth_from(c, 1.5 * kBirthVolume, 7, 0);
  EXPECT_EQ(none.at(10 * kDay), 1.5 * kBirthVolume);
  EXPECT_EQ(growth_from(c, 2 * c.birth_volume, 7, 1).at(kDay), 2 * c.birth_volume);
}

TEST(CellCycle, FactorHasTheLimitsOfAHillFunction) {
  EXPECT_EQ(growth_factor({}, {1e9, 0.1}), 1);
  const Inhibition pressure{InhibitedBy::kPressure, 0.2, 4};
  EXPECT_EQ(growth_factor(pressure, {0}), 1);
  EXPECT_EQ(growth_factor(pressure, {-5}), 1) << "pulled, not pressed";
  EXPECT_EQ(growth_factor(pressure, {0.2}), 0.5);
  EXPECT_NEAR(growth_factor(pressure, {0.4}), 1.0 / 17, kCycleRoundOff);
  EXPECT_LT(growth_factor(pressure, {2}), 1.01e-4);
  const Inhibition volume{InhibitedBy::kVolume, 0.8, 4};
  EXPECT_EQ(growth_factor(volume, {5, 0.8}), 0.5);
  EXPECT_NEAR(growth_factor(volume, {5, 1.6}), 16.0 / 17, kCycleRoundOff);
  EXPECT_LT(growth_factor(volume, {5, 0.08}), 1.01e-4);
  EXPECT_GT(growth_factor(volume, {5, 8}), 1 - 1.01e-4);
  EXPECT_EQ(growth_factor({InhibitedBy::kVolume, 5e-4, 100}, {5, 1}), 1) << "x^100 overflows";
  EXPECT_EQ(growth_factor({InhibitedBy::kPressure, 0.2, 1}, {0.4}), 1.0 / (1 + 0.4 / 0.2));
}

TEST(CellCycle, CycleTimesAreGaussianAndCutAtThreeSigma) {
  const CycleParams p = cycle_params();
  const double sigma = 0.1 * kDay;
  const int n = 1000;
  double sum = 0, sum2 = 0, third = 0, farthest = 0;
  int within = 0;
  for (int k = 0; k < n; ++k) {
    const double x = (draw_cycle_time(p, 7, k) - kDay) / sigma;
    sum += x, sum2 += x * x, third += x * x * x;
    farthest = std::max(farthest, std::abs(x));
    within += std::abs(x) < 1 ? 1 : 0;
  }
  const double deviation = std::sqrt(sum2 / n);
  std::printf("cycle times: mean %.4f, deviation %.3f, farthest %.2f sigma\n", sum / n, deviation,
              farthest);
  // Four standard errors: 1/sqrt(n) of the mean, 1/sqrt(2 n) of the deviation, sqrt(15/n) of the
  // third moment; cut at 3 the deviation is 0.987 and the share within one sigma 0.6845.
  EXPECT_LT(std::abs(sum / n), 4 / std::sqrt(n));
  EXPECT_NEAR(deviation, 0.9866, 4 * 0.9866 / std::sqrt(2 * n));
  EXPECT_LT(std::abs(third / n), 4 * std::sqrt(15.0 / n));
  EXPECT_NEAR(within / 1000.0, 0.6845, 4 * std::sqrt(0.6845 * 0.3155 / n));
  EXPECT_LE(farthest, 3);
  EXPECT_NE(draw_cycle_time(p, 8, 0), draw_cycle_time(p, 7, 0)) << "of the seed";
  EXPECT_EQ(draw_cycle_time(cycle_params(0), 7, 0), kDay);
}

}  // namespace
}  // namespace acinus::coupling

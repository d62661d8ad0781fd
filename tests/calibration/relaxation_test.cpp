/// Relaxation times: the fit of a decay, and the exact scaling of times with friction.

#include "calibration/clump_relaxation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "tests/coupling/worlds.hpp"

namespace acinus::calibration {
namespace {

TEST(Decay, IsFoundWhateverTheSpacingOfSamples) {
  for (const bool even : {true, false}) {
    std::vector<double> t, y;
    for (int k = 0; k <= 100; ++k) {
      t.push_back(even ? 60.0 * k : std::expm1(0.09 * k));
      y.push_back(0.05 + 0.12 * std::exp(-t.back() / 700));
    }
    const Decay d = fit_decay(t, y);
    EXPECT_NEAR(d.time, 700, 0.1);
    EXPECT_NEAR(d.start, 0.17, 1e-5);
    EXPECT_NEAR(d.end, 0.05, 1e-5);
    EXPECT_LT(d.rms, 1e-6);
  }
}

/// Two deformable cells pushed into each other by 2 um.
coupling::World pressed_pair() {
  coupling::World w = coupling::make_test_world({{Vec3::Zero()}, {Vec3(22, 0, 0)}}, 60, 42);
  w.params.numerics.adaptive = true;
  w.params.numerics.tolerance = 0.05;
  w.params.numerics.max_move = 0.3;
  w.params.numerics.cg.tolerance = 1e-8;
  return w;
}

TEST(Relaxation, FiveTimesTheFrictionTakesFiveTimesAsLong) {
  const coupling::World world = pressed_pair();
  coupling::World slow = world;
  scale_all_friction(slow.params, 5);
  const Relaxation fast = relax_clump(world, 1), five = relax_clump(slow, 5);
  // How long each is followed depends on the last digits of a slow tail: the same part is compared.
  const std::size_t n = std::min(fast.time.size(), five.time.size());
  const double way = std::abs(fast.overlap[n - 1] - fast.overlap[0]);
  for (std::size_t k = 0; k < n; ++k) {
    EXPECT_NEAR(five.time[k], 5 * fast.time[k], 1e-6 * five.time[k]);
    EXPECT_NEAR(five.overlap[k], fast.overlap[k], 0.01 * way) << fast.time[k];
  }
  const Decay one = fit_decay(std::span(fast.time).first(n), std::span(fast.overlap).first(n)),
              slower = fit_decay(std::span(five.time).first(n), std::span(five.overlap).first(n));
  EXPECT_GT(one.time, 1);
  EXPECT_NEAR(slower.time / one.time, 5, 0.05);
}

}  // namespace
}  // namespace acinus::calibration

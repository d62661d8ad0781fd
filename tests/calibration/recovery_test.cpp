/// How a quantity goes back after a release.

#include "calibration/recovery.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace acinus::calibration {
namespace {

struct Course {
  std::vector<double> t, y;
};

/// A jump of `at_once` within seconds, then a slow decay, over a time on a logarithmic grid.
Course make_course(double at_once, double slow, double end, double scale = 1) {
  Course c;
  c.t.push_back(0);
  for (double t = 1; t < end; t *= 1.05) c.t.push_back(t);
  c.t.push_back(end);
  for (const double t : c.t)
    c.y.push_back(3 + scale * (at_once * std::exp(-t) + (1 - at_once) * std::exp(-t / slow)));
  return c;
}

TEST(Recovery, TellsTheJumpFromTheRest) {
  for (const double sign : {1.0, -2.0}) {
    const Course c = make_course(0.4, 700, 20000, sign);
    const Recovery r = measure_recovery(c.t, c.y);
    // after 10 s the slow part has done 1.4 % of itself; straight lines between samples 5 % apart
    // are off by (0.05 t)^2 / 8 y'': less than 1e-3 of the way
    EXPECT_NEAR(r.sprung, 1 - 0.6 * std::exp(-10.0 / 700), 1e-3);
    EXPECT_NEAR(r.efold, 700, 2);
    EXPECT_NEAR(r.time, 700 * std::log(60), 10);  // 0.6 exp(-t / 700) = 0.01
  }
}

TEST(Recovery, NothingIsKnownOfWhatStillMoves) {
  const Course c = make_course(0.4, 700, 3000);
  EXPECT_TRUE(std::isnan(measure_recovery(c.t, c.y).time));
  EXPECT_TRUE(std::isnan(measure_recovery(c.t, c.y).efold));
  const std::vector<double> t{0, 1, 20, 4000}, still{2, 2, 2, 2};
  EXPECT_TRUE(std::isnan(measure_recovery(t, still).time));
  EXPECT_TRUE(std::isnan(measure_recovery({}, {}).time));
}

TEST(Recovery, WhatSpringsBackWhollyHasNoSlowPart) {
  const Course c = make_course(1, 1, 1000);
  const Recovery r = measure_recovery(c.t, c.y);
  EXPECT_NEAR(r.sprung, 1, 1e-4);
  EXPECT_TRUE(std::isnan(r.efold));
  EXPECT_NEAR(r.time, std::log(100), 0.02);
}

TEST(Recovery, EndsWhereItTurnsRound) {
  // slow creep the other way, a twentieth of the way in the end
  Course c = make_course(0.4, 700, 40000);
  for (std::size_t k = 0; k < c.t.size(); ++k) c.y[k] += 0.05 * c.t[k] / c.t.back();
  const Recovery r = measure_recovery(c.t, c.y);
  // 0.6 exp(-t / 700) + 1.25e-6 t is least at t = 700 ln(0.6 / 700 / 1.25e-6) = 4571 s
  EXPECT_NEAR(r.end, 3 + 0.6 * std::exp(-4571.0 / 700) + 1.25e-6 * 4571, 1e-4);
  EXPECT_NEAR(r.efold, 700, 15);  // the end is not the one it would have gone to
  // of the way of 0.9934 a hundredth is left where the sum is 0.01652
  EXPECT_NEAR(r.time, 2672, 10);
}

}  // namespace
}  // namespace acinus::calibration

/// Recovery of a quantity after a release.

#include "calibration/recovery.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace acinus::calibration {
namespace {

struct Course {
  std::vector<double> t, y;
};

/// Jump of `at_once` within seconds, then a slow decay, over a time on a logarithmic grid.
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

// 0.4 is gone at once, of the rest 0.6 exp(-t / 700): twice as long brings 1 % more until 2870 s.
TEST(Recovery, HasNoTimeWhileItMoves) {
  const Course c = make_course(0.4, 700, 5000);
  const Recovery r = measure_recovery(c.t, c.y);
  EXPECT_TRUE(std::isnan(r.time));
  EXPECT_NEAR(r.efold, 700, 10) << "of the way so far";
  EXPECT_FALSE(std::isnan(
      measure_recovery(make_course(0.4, 700, 6000).t, make_course(0.4, 700, 6000).y).time));
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

// Slow creep on, or back, of a twentieth of the way in 11 h: in the 1.3 h that the rest takes it
// does less than 1 %.
TEST(Recovery, EndsWhereOnlyCreepIsLeft) {
  for (const double creep : {-0.05, 0.05}) {
    Course c = make_course(0.4, 700, 40000);
    for (std::size_t k = 0; k < c.t.size(); ++k) c.y[k] += creep * c.t[k] / c.t.back();
    const Recovery r = measure_recovery(c.t, c.y);
    EXPECT_NEAR(r.end, 3, 0.01);
    EXPECT_NEAR(r.efold, 700, 30);
    EXPECT_NEAR(r.time, 700 * std::log(60), 700);  // the level moves by as much as 1 %
  }
}

// A curve that turns round at the beginning has not come to its end there.
TEST(Recovery, IsNotOverAtAnEarlyTurn) {
  Course c = make_course(0, 700, 20000);
  for (std::size_t k = 0; k < c.t.size(); ++k)
    c.y[k] += 0.03 * std::sin(std::min(c.t[k], 30.0) / 4);
  const Recovery r = measure_recovery(c.t, c.y);
  EXPECT_NEAR(r.efold, 700, 30);
  EXPECT_GT(r.time, 2000);
}

}  // namespace
}  // namespace acinus::calibration

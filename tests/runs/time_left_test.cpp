#include "runs/session/time_left.hpp"

#include <gtest/gtest.h>

namespace acinus::runs {
namespace {

/// Steps of half a second of wall time at a steady rate.
void go(TimeLeft& left, double& wall, double& time, double seconds, double rate) {
  const double end = wall + seconds;
  while (wall < end) {
    wall += 0.5;
    time += 0.5 * rate;
    left.add(wall, time);
  }
}

TEST(TimeLeftOfARun, IsNotToldWithoutABasis) {
  TimeLeft left;
  double wall = 1000, time = 7200;
  left.begin(wall, time);
  EXPECT_FALSE(left.until(1e5).has_value());
  go(left, wall, time, 29, 10);
  EXPECT_FALSE(left.until(1e5).has_value());
  go(left, wall, time, 1, 10);
  ASSERT_TRUE(left.until(1e5).has_value());
  EXPECT_EQ(*left.until(time), 0);
  left.restart();
  EXPECT_FALSE(left.until(1e5).has_value()) << "another phase";
}

TEST(TimeLeftOfARun, IsExactAtASteadyRate) {
  TimeLeft left;
  double wall = 0, time = 0;
  left.begin(wall, time);
  go(left, wall, time, 100, 40);
  EXPECT_NEAR(left.rate(), 40, 1e-9 * 40);  // sums of 200 fading terms
  EXPECT_NEAR(*left.until(time + 8000), 200, 1e-9 * 200);
}

TEST(TimeLeftOfARun, ForgetsShortFirstStepsAndCheaperTimes) {
  TimeLeft left;
  double wall = 0, time = 0;
  left.begin(wall, time);
  go(left, wall, time, 60, 1);     // short steps
  go(left, wall, time, 120, 100);  // the mean rate is 67
  EXPECT_NEAR(left.rate(), 100, 3);
  go(left, wall, time, 240, 10);  // the tissue has grown: the mean rate is 34
  EXPECT_NEAR(left.rate(), 10, 3);
  EXPECT_GT(*left.until(time + 1000), 75) << "it takes 100 s, the mean rate says 29";
}

TEST(TimeLeftOfARun, StandsStillWithoutSteps) {
  TimeLeft left;
  left.begin(0, 0);
  left.add(100, 0);
  EXPECT_FALSE(left.until(1000).has_value());
}

}  // namespace
}  // namespace acinus::runs

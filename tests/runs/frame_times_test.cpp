/// Frames after something opened.

#include "runs/scene/frame_times.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace acinus::runs {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

Scene make_scene() {
  Scene s;
  s.capsule.enabled = true;
  s.capsule.opens = 500;
  s.walls.resize(2);
  s.walls[1].opens = 100;
  s.output.after_opening = 2;
  return s;
}

TEST(FrameTimes, FollowEveryOpeningOnALogarithmicGrid) {
  const Scene s = make_scene();
  EXPECT_EQ(next_opening(s, 0), 100);
  EXPECT_EQ(next_opening(s, 100), 500);
  EXPECT_EQ(next_opening(s, 500), kNever);
  std::vector<double> t;
  for (double now = 0; t.size() < 9; now = t.back()) t.push_back(next_frame_of_opening(s, now));
  const double r = std::sqrt(10.0);
  const double expected[] = {100, 101, 100 + r, 110, 100 + 10 * r, 200, 100 + 100 * r, 500, 501};
  for (std::size_t k = 0; k < 9; ++k) EXPECT_NEAR(t[k], expected[k], 1e-9);
  // A step that ends a rounding error early or late is at that moment all the same.
  EXPECT_NEAR(next_frame_of_opening(s, 110 - 1e-9), 100 + 10 * r, 1e-9);
  EXPECT_NEAR(next_frame_of_opening(s, 110 + 1e-9), 100 + 10 * r, 1e-9);
}

TEST(FrameTimes, AreNoneUnlessAskedFor) {
  Scene s = make_scene();
  s.output.after_opening = 0;
  EXPECT_EQ(next_frame_of_opening(s, 0), kNever);
  EXPECT_EQ(next_opening(s, 0), 100) << "steps end there all the same";
  s.capsule.enabled = false;
  EXPECT_EQ(next_opening(s, 100), kNever);
  s = make_scene();
  s.walls.clear();
  s.capsule.opens.reset();
  EXPECT_EQ(next_frame_of_opening(s, 0), kNever);
}

}  // namespace
}  // namespace acinus::runs

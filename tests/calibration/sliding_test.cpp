/// Distance that one layer of cells slides over another.

#include "calibration/sliding.hpp"

#include <gtest/gtest.h>

namespace acinus::calibration {
namespace {

TEST(Sliding, LayersAreToldByTheFirstFrame) {
  const std::vector<Vec3> first{{0, 0, 10}, {20, 0, 10.5}, {3, 0, -9}, {23, 5, -9.5}};
  EXPECT_DOUBLE_EQ(offset_of_layers(first, first), -3);
  // The upper layer goes right, and one of its cells sinks below the middle.
  const std::vector<Vec3> later{{8, 0, 9}, {28, 0, -1}, {1, 0, -9}, {21, 5, -9.5}};
  EXPECT_DOUBLE_EQ(offset_of_layers(first, later), 7);
}

TEST(Sliding, IsSteadyAfterAThirdOfTheTime) {
  // An elastic jump of 2 um, then 0.5 um in an hour.
  Slide slide;
  for (int hour = 0; hour <= 6; ++hour) {
    slide.time.push_back(3600.0 * hour);
    slide.slid.push_back(hour == 0 ? 0 : 2 + 0.5 * hour);
  }
  EXPECT_DOUBLE_EQ(steady_slide(slide), 2);
}

}  // namespace
}  // namespace acinus::calibration

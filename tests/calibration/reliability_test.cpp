#include "calibration/reliability.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "tests/messages.hpp"

namespace acinus::calibration {
namespace {

TEST(Reliability, ClumpsThatStandForTissueGiveNoWarning) {
  EXPECT_TRUE(list_warnings(15, 0.025).empty()) << "59 cells";
  EXPECT_TRUE(list_warnings(51, 0.17).empty()) << "113 cells";
}

TEST(Reliability, FewInnerCellsAreToldWithWhatTheyKnow) {
  const std::vector<std::string> five = list_warnings(5, 0.06);
  ASSERT_EQ(five.size(), 1u) << "27 cells: a small error by chance";
  EXPECT_CONTAINS(five[0], "cells that are not at the capsule: 5;");
  EXPECT_CONTAINS(five[0], "a factor of 1.4");
  EXPECT_CONTAINS(five[0], "--cells 59");
  EXPECT_EQ(list_warnings(kFewestInner - 1, 0).size(), 1u);
  EXPECT_EQ(list_warnings(kFewestInner, 0).size(), 0u);
}

TEST(Reliability, AnErrorWhereNothingWasFittedIsTold) {
  const std::vector<std::string> buckled = list_warnings(15, 0.44);
  ASSERT_EQ(buckled.size(), 1u);
  EXPECT_CONTAINS(buckled[0], "44 % off");
  EXPECT_EQ(list_warnings(1, 0.83).size(), 2u) << "15 cells";
  EXPECT_EQ(list_warnings(15, std::numeric_limits<double>::quiet_NaN()).size(), 1u);
}

}  // namespace
}  // namespace acinus::calibration
